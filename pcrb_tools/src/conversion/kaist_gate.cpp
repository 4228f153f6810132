#include "conversion/kaist_gate.hpp"

#include <cstdlib>
#include <filesystem>
#include <utility>

#include "conversion/pose_text.hpp"
#include "pcrb_core/error.hpp"

namespace pcrb_tools {
namespace {

constexpr const char* kPoseFile = "global_pose.csv";
constexpr const char* kLeftCalibration = "Vehicle2LeftVLP.txt";
constexpr const char* kRightCalibration = "Vehicle2RightVLP.txt";

/// Parses the file that is asked for, else the one of that name in the log.
template <typename Parse>
auto parseFile(const std::string& path, const LogFiles* log, const char* name, Parse parse) {
  if (!path.empty()) return parse(pcrb::FileBytes(path).text(), path);
  std::vector<std::size_t> found;
  if (log != nullptr) {
    found = log->find([name](const LogFile& file) { return file.fileName() == name; });
  }
  if (found.size() != 1) {
    throw pcrb::InvalidFile(log == nullptr ? "input" : log->all().front().container, 0,
                            std::to_string(found.size()) + " files " + name, "one");
  }
  return parse(log->text(found.front()), log->all()[found.front()].path());
}

}  // namespace

bool isFrameFile(const LogFile& file) {
  const std::string name = file.fileName();
  return name == kPoseFile || name == kLeftCalibration || name == kRightCalibration;
}

KaistFrames readFrames(const KaistRequest& request, const LogFiles* log) {
  return {parseFile(request.left_calibration, log, kLeftCalibration, pcrb::parseKaistCalibration),
          parseFile(request.right_calibration, log, kRightCalibration, pcrb::parseKaistCalibration),
          parseFile(request.poses, log, kPoseFile, pcrb::parseKaistTrajectory)};
}

KaistGate::KaistGate(const KaistFrames& frames, const KaistRequest& request,
                     const std::string& sequence, Conversion& conversion)
    : frames_(frames),
      request_(request),
      sequence_(sequence),
      conversion_(conversion),
      limiter_(request.max_rate) {
  if (frames.trajectory.duplicates() > 0) {
    conversion.note(std::to_string(frames.trajectory.duplicates()) +
                    " poses have the stamp of a later one and were not used");
  }
}

std::optional<KaistGate::Pair> KaistGate::admit(pcrb::Stamp left,
                                                std::optional<pcrb::Stamp> right) {
  const std::string name = pcrb::kaistCloudName(sequence_, left);
  const auto drop = [&](const std::string& reason) {
    conversion_.drop(name, reason);
    return std::nullopt;
  };
  if (clock_.goesBack(left)) conversion_.noteGoingBack();
  if (!right || std::abs(*right - left) > request_.options.max_pair_gap) {
    return drop("no right scan close in time");
  }
  const auto left_pose = pcrb::kaistPose(frames_.trajectory, left, request_.options);
  const auto right_pose = pcrb::kaistPose(frames_.trajectory, *right, request_.options);
  if (left_pose.status != pcrb::PoseStatus::kFound) return drop(toString(left_pose.status));
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

const char* KaistGate::refuse(pcrb::Stamp left, pcrb::Stamp right) {
  const bool is_due = limiter_.keep(left);  // asked of a repetition, too: it has its place in time
  const auto earlier = partners_.find(left);
  if (earlier == partners_.end() && !is_due) return "beyond the maximal rate";
  if (earlier != partners_.end()) {
    const auto ranked = [left](pcrb::Stamp other) {
      return std::pair(std::abs(other - left), other);
    };
    if (ranked(right) >= ranked(earlier->second)) return "the stamp of an earlier one";
    conversion_.takeBack(pcrb::kaistCloudName(sequence_, left));
  }
  partners_[left] = right;
  return nullptr;
}

ConvertedScan mergePair(const KaistFrames& frames, const KaistGate::Pair& pair,
                        pcrb::SensorScan left, pcrb::SensorScan right) {
  pcrb::PointCounts counts = left.counts;
  counts += right.counts;
  return {pcrb::mergeScans({std::move(left), pair.T_world_vehicle_left, frames.T_vehicle_left},
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

}  // namespace pcrb_tools
