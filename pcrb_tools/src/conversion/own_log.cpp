#include "conversion/own_log.hpp"

#include <filesystem>
#include <utility>

#include "archives/archive_reader.hpp"
#include "archives/bag_messages.hpp"
#include "pcrb_core/error.hpp"

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

std::string originText(const OwnRequest& request, const ScanPlace& place) {
  return std::string(request.deskew ? "deskew" : "") +
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
      !conversion_.wants(scan.name, identity_ + '\n' + originText(request_, place))) {
    return;
  }
  conversion_.add(scan.name, [&request = request_, &placement = placement_, place, scan] {
    return placeOwnScan(request, placement, place, scan.stamp, scan.read(), scan.name);
  });
}

ConversionReport convertOwn(const OwnRequest& request) {
  if (request.deskew && request.in_world) {
    throw pcrb::InvalidParameter(
        "found --deskew and --in-world, expected one of them: points in "
        "the world's frame were moved already");
  }
  return areBags(request.inputs) ? convertOwnBags(request) : convertOwnFiles(request);
}

}  // namespace pcrb_tools
