#include "pcrb_core/datasets/deskew.hpp"

#include <cmath>
#include <limits>
#include <map>

namespace pcrb {

Stamp pointStamp(Stamp scan, double time) {
  constexpr double kSince1970 = 1e8;   // s: no turn of a sensor takes three years
  constexpr double kYear2200 = 7.3e9;  // s
  // Since 1970 in ms, µs or ns, as drivers have it in doubles: no offset is that large.
  for (int i = 0; i != 3 && std::abs(time) >= kYear2200; ++i) time /= 1000.0;
  if (!(std::abs(time) < kYear2200)) return std::numeric_limits<Stamp>::max() / 2;
  // In two parts: a double of 1.5e18 ns has steps of 256.
  const double seconds = std::floor(time);
  const Stamp ns = static_cast<Stamp>(seconds) * kSecond +
                   std::llround((time - seconds) * static_cast<double>(kSecond));
  return std::abs(time) > kSince1970 ? ns : scan + ns;
}

PoseStatus placeMovingScan(const SensorScan& scan, Stamp stamp, const PoseAt& pose_at,
                           DatasetCloud& cloud) {
  const PoseLookup at_stamp = pose_at(stamp);
  if (at_stamp.status != PoseStatus::kFound) return at_stamp.status;
  std::map<Stamp, Transform> poses;  // many points share a time
  cloud = {};
  cloud.points.reserve(scan.points.size());
  for (std::size_t i = 0; i != scan.points.size(); ++i) {
    const Stamp time = pointStamp(stamp, scan.times[i]);
    auto pose = poses.find(time);
    if (pose == poses.end()) {
      const PoseLookup found = pose_at(time);
      if (found.status != PoseStatus::kFound) return found.status;
      pose = poses.emplace(time, found.T_world_body).first;
    }
    cloud.points.emplace_back(pose->second * scan.points[i]);
  }
  cloud.viewpoint = asViewpoint(at_stamp.T_world_body);
  cloud.is_viewpoint_known = true;
  cloud.dropped_non_finite = scan.counts.non_finite;
  return PoseStatus::kFound;
}

}  // namespace pcrb
