#include "conversion/kaist_stream.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "conversion/conversion.hpp"
#include "conversion/raw_scans.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_server/message_conversion.hpp"

namespace pcrb_tools {
namespace {

constexpr const char* kGlobalPoseFile = "global_pose.csv";
constexpr const char* kLeftCalibration = "Vehicle2LeftVLP.txt";
constexpr const char* kRightCalibration = "Vehicle2RightVLP.txt";

/// How far the two streams may be apart, at least.
constexpr pcrb::Stamp kPatience = 5 * pcrb::kSecond;

}  // namespace

bool isFrameFile(const LogFile& file) {
  const std::string name = file.fileName();
  return name == kGlobalPoseFile || name == kLeftCalibration || name == kRightCalibration;
}

KaistFrames readFrames(const KaistRequest& request, const LogFiles* log) {
  return {
      parseChosen(request.left_calibration, log, kLeftCalibration, pcrb::parseKaistCalibration),
      parseChosen(request.right_calibration, log, kRightCalibration, pcrb::parseKaistCalibration),
      parseChosen(request.poses, log, kGlobalPoseFile, pcrb::parseKaistTrajectory)};
}

KaistScanSelector::KaistScanSelector(const KaistFrames& frames, const KaistRequest& request,
                                     const std::string& sequence, Conversion& conversion)
    : frames_(frames),
      request_(request),
      sequence_(sequence),
      conversion_(conversion),
      limiter_(request.max_rate) {
  announcePoses(frames.trajectory, conversion);
}

std::optional<KaistScanSelector::Pair> KaistScanSelector::select(pcrb::Stamp left,
                                                                 std::optional<pcrb::Stamp> right) {
  const std::string name = pcrb::kaistCloudName(sequence_, left);
  const auto drop = [&](const std::string& reason) {
    conversion_.drop(name, reason);
    return std::nullopt;
  };
  if (clock_.goesBack(left)) conversion_.noteTimeJump();
  if (!right || std::abs(*right - left) > request_.options.max_pair_gap) {
    return drop("no right scan close in time");
  }
  const auto left_pose = pcrb::kaistPose(frames_.trajectory, left, request_.options);
  const auto right_pose = pcrb::kaistPose(frames_.trajectory, *right, request_.options);
  if (left_pose.status != pcrb::PoseStatus::kFound) {
    conversion_.dropUnposed(name, left, toString(left_pose.status));
    return std::nullopt;
  }
  if (right_pose.status != pcrb::PoseStatus::kFound) {
    return drop(std::string("the right scan is ") + toString(right_pose.status));
  }
  if (const char* reason = refuse(left, *right)) return drop(reason);
  const std::string origin = std::to_string(*right) + poseText(left_pose.T_world_body) +
                             poseText(right_pose.T_world_body) + poseText(frames_.T_vehicle_left) +
                             poseText(frames_.T_vehicle_right) +
                             (request_.origin == pcrb::OriginPoints::kDrop ? " drop" : " keep");
  return Pair{name, left_pose.T_world_body, right_pose.T_world_body, origin};
}

const char* KaistScanSelector::refuse(pcrb::Stamp left, pcrb::Stamp right) {
  const bool is_due = limiter_.keep(left);  // asked of a repetition, too: it has its place in time
  const auto earlier = partners_.find(left);
  if (earlier == partners_.end() && !is_due) return "beyond the maximal rate";
  if (earlier != partners_.end()) {
    const auto ranked = [left](pcrb::Stamp other) {
      return std::pair(std::abs(other - left), other);
    };
    if (ranked(right) >= ranked(earlier->second)) return "the stamp of an earlier one";
    conversion_.retract(pcrb::kaistCloudName(sequence_, left));
  }
  partners_[left] = right;
  return nullptr;
}

ConvertedScan mergePair(const KaistFrames& frames, const KaistScanSelector::Pair& pair,
                        pcrb::SensorScan left, pcrb::SensorScan right) {
  pcrb::PointCounts counts = left.counts;
  counts += right.counts;
  return {{},
          pcrb::mergeScans({std::move(left), pair.T_world_vehicle_left, frames.T_vehicle_left},
                           {std::move(right), pair.T_world_vehicle_right, frames.T_vehicle_right}),
          counts};
}

std::string kaistSequence(const KaistRequest& request, const std::string& path) {
  if (!request.sequence.empty()) return request.sequence;
  std::string found;
  for (const auto& part : std::filesystem::absolute(path).lexically_normal()) {
    const std::string name = pcrb::kaistSequenceName(part.string());
    if (!name.empty()) found = name;
  }
  if (found.empty()) {
    throw pcrb::InvalidParameter("found no name like urban05 in the path " + path +
                                 ", expected the sequence with --sequence");
  }
  return found;
}

KaistStream::KaistStream(const KaistFrames& frames, const KaistRequest& request,
                         const std::string& sequence, const std::string& identity,
                         Conversion& conversion)
    : frames_(frames),
      request_(request),
      identity_(identity),
      conversion_(conversion),
      selector_(frames, request, sequence, conversion),
      pairer_(std::max(kPatience, 2 * request.options.max_pair_gap)) {}

void KaistStream::addLeft(const Message& message) {
  convert(pairer_.addLeft(pcrb::stampOf(message->header.stamp), message));
}

void KaistStream::addRight(const Message& message) {
  convert(pairer_.addRight(pcrb::stampOf(message->header.stamp), message));
}

void KaistStream::finish() { convert(pairer_.flush()); }

void KaistStream::convert(const std::vector<Pairer::Pair>& pairs) {
  for (const auto& pair : pairs) {
    const auto right_stamp = pair.right ? std::optional(pair.right->first) : std::nullopt;
    const auto admitted = selector_.select(pair.left_stamp, right_stamp);
    if (!admitted || !conversion_.wants(admitted->cloud_name, identity_ + admitted->origin)) {
      continue;
    }
    conversion_.add(admitted->cloud_name, [&frames = frames_, &request = request_, left = pair.left,
                                           right = pair.right->second, admitted = *admitted] {
      const std::string name = ' ' + admitted.cloud_name;
      return mergePair(frames, admitted, scanOf(*left, request.origin, request.left_topic + name),
                       scanOf(*right, request.origin, request.right_topic + name));
    });
  }
}

}  // namespace pcrb_tools
