#include "conversion/own_log.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "archives/archive_reader.hpp"
#include "archives/bag_messages.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"

namespace pcrb_tools {

std::string sequenceOf(const OwnRequest& request) {
  namespace fs = std::filesystem;
  if (!request.sequence.empty()) return request.sequence;
  const fs::path input =
      fs::absolute(request.inputs.front() + "/").lexically_normal().parent_path();
  std::string name = input.filename().string();
  if (isBag(name) || isArchiveName(name)) name.resize(name.rfind('.'));
  const std::size_t inner = name.rfind('.');
  const bool is_double =
      inner != std::string::npos && (name.substr(inner) == ".tar" || name.substr(inner) == ".bag");
  return is_double ? name.substr(0, inner) : name;
}

namespace {

/// Times in another unit would give each point a pose, and a wrong one.
void requireScanTimes(const std::vector<double>& times, const std::string& name) {
  constexpr double kShortest = 1e-3;  // s
  constexpr double kLongest = 60.0;   // s: a slow tilting scanner's
  if (times.empty()) return;
  const auto [first, last] = std::minmax_element(times.begin(), times.end());
  const double span =
      static_cast<double>(pcrb::pointStamp(0, *last) - pcrb::pointStamp(0, *first)) /
      static_cast<double>(pcrb::kSecond);
  if (span <= 0.0 || (span >= kShortest && span <= kLongest)) return;
  throw pcrb::InvalidFile(name, 0, "points over " + pcrb::formatShortest(span) + " s",
                          "0.001 to 60 s: times that are floats in seconds, integers in ns");
}

/// Options of the other kind of log would be passed over in silence.
void requireOptionsOfKind(const OwnRequest& request, bool are_bags) {
  struct Option {
    const char* name;
    bool is_of_bags;
    bool is_given;
  };
  const Option options[] = {
      {"--cloud-topic", true, !request.cloud_topic.empty()},
      {"--topic", true, !request.pose_topic.empty()},
      {"--tf", true, !request.tf.empty()},
      {"--world-frame", true, !request.world_frame.empty()},
      {"--body-frame", true, !request.body_frame.empty()},
      {"--times", false, !request.times.empty()},
      {"--bin-fields", false, request.files.bin_fields != pcrb::CloudFileOptions().bin_fields}};
  for (const Option& option : options) {
    if (!option.is_given || option.is_of_bags == are_bags) continue;
    throw pcrb::InvalidParameter(
        std::string(option.name) + ": found " +
        (are_bags ? "bags, expected" : "no bag, expected one in place of") + " files of clouds");
  }
}

}  // namespace

ConvertedScan placeOwnScan(const OwnRequest& request, const Placement& placement,
                           const ScanPlace& place, pcrb::Stamp stamp, pcrb::SensorScan scan,
                           const std::string& name) {
  ConvertedScan converted;
  converted.counts = scan.counts;
  if (request.deskew) {
    if (scan.times.empty() && !scan.points.empty()) {
      throw pcrb::InvalidFile(name, 0, "points without a field of their times",
                              "time, t, timestamp or offset_time (or no --deskew)");
    }
    requireScanTimes(scan.times, name);
    const auto sensor_at = [&](pcrb::Stamp time) { return placement.sensorAt(time); };
    const pcrb::PoseStatus status = pcrb::placeMovingScan(scan, stamp, sensor_at, converted.cloud);
    if (status != pcrb::PoseStatus::kFound) {
      converted.refusal = std::string("some points ") + pcrb::toString(status);
    }
    return converted;
  }
  converted.cloud = pcrb::placeScan(std::move(scan), place.T_world_cloud);
  converted.cloud.viewpoint = pcrb::asViewpoint(place.T_world_sensor);
  return converted;
}

std::string originText(const OwnRequest& request, const Placement& placement,
                       const ScanPlace& place) {
  return (request.deskew ? "deskew" + placement.identity : "") +
         (request.files.origin == pcrb::OriginPoints::kDrop ? " drop " : " keep ") +
         std::to_string(request.files.bin_fields) + poseText(place.T_world_cloud) +
         poseText(place.T_world_sensor);
}

OwnScans::OwnScans(const OwnRequest& request, const Placement& placement,
                   const std::string& identity, Conversion& conversion)
    : request_(request),
      placement_(placement),
      identity_(identity),
      conversion_(conversion),
      thinner_(request, conversion) {
  conversion.setPoseStamps(placement.stamps);
  conversion.noteDuplicatePoses(placement.duplicates);
}

void OwnScans::add(Scan scan) {
  if (!seen_.insert(scan.stamp).second) {
    conversion_.drop(scan.name, "the stamp of an earlier one");
    return;
  }
  ScanPlace place;
  const pcrb::PoseStatus status = placement_.find(scan.stamp, place);
  if (status != pcrb::PoseStatus::kFound) {
    conversion_.dropUnposed(scan.name, scan.stamp, pcrb::toString(status));
    return;
  }
  if (!thinner_.keep(scan.name, scan.stamp, place.T_world_sensor) ||
      !conversion_.wants(scan.name, identity_ + '\n' + originText(request_, placement_, place))) {
    return;
  }
  conversion_.add(scan.name, [&request = request_, &placement = placement_, place, scan] {
    return placeOwnScan(request, placement, place, scan.stamp, scan.read(), scan.name);
  });
}

void requireTimestamps(const OwnRequest& request, const std::string& poses) {
  const char* const option = request.deskew               ? "--deskew"
                             : request.time_offset != 0.0 ? "--time-offset"
                             : request.max_rate > 0.0     ? "--max-rate"
                                                          : nullptr;
  if (option == nullptr) return;
  throw pcrb::InvalidFile(poses, 0, "poses without timestamps",
                          std::string("timestamps, which ") + option + " needs");
}

ConversionReport convertOwn(const OwnRequest& request) {
  if (request.deskew && request.in_world) {
    throw pcrb::InvalidParameter(
        "found --deskew and --in-world, expected one of them: points in "
        "the world's frame were moved already");
  }
  const bool are_bags = areBags(request.inputs);
  requireOptionsOfKind(request, are_bags);
  return are_bags ? convertOwnBags(request) : convertOwnFiles(request);
}

}  // namespace pcrb_tools
