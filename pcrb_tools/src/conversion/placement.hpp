#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "conversion/conversion.hpp"
#include "conversion/own_request.hpp"
#include "pcrb_core/datasets/deskew.hpp"
#include "pcrb_core/datasets/tum.hpp"

namespace pcrb_tools {

/// Where a scan belongs.
struct ScanPlace {
  pcrb::Transform T_world_cloud = pcrb::Transform::Identity();  ///< moves its points
  pcrb::Transform T_world_sensor = pcrb::Transform::Identity();
};

/// What places the scans of a log of one's own.
struct Placement {
  pcrb::PoseAt body;  ///< T_world_body in time
  pcrb::Transform T_body_sensor = pcrb::Transform::Identity();
  bool in_world = false;            ///< the clouds are in the frame of the poses already
  pcrb::PoseAt world;               ///< T_wanted_world; empty = the same
  std::vector<pcrb::Stamp> stamps;  ///< of the poses, ascending, for messages
  std::size_t duplicates = 0;       ///< poses that were left out, as a later one has their stamp

  std::string identity;  ///< of all poses and the offset, for fingerprints

  /// The sensor's pose in the wanted frame.
  pcrb::PoseLookup sensorAt(pcrb::Stamp stamp) const;

  /// @return  why there is no place; `place` is set where it is kFound.
  pcrb::PoseStatus find(pcrb::Stamp stamp, ScanPlace& place) const;
};

/// A placement by the body's poses, with their ascending stamps, both moved by the request's
/// offset.
Placement placementBy(pcrb::PoseAt body, std::vector<pcrb::Stamp> stamps,
                      const OwnRequest& request);

/// The same by a trajectory.
Placement placementBy(const pcrb::Trajectory& trajectory, const OwnRequest& request);

/// Decides which scans become clouds: those with a pose, far enough from the one before in space
/// and time.
class ScanThinner {
 public:
  ScanThinner(const OwnRequest& request, Conversion& conversion);

  /// Whether a scan is kept; if not, it was dropped with the reason. Scans without a stamp are not
  /// thinned by time.
  bool keep(const std::string& name, std::optional<pcrb::Stamp> stamp,
            const pcrb::Transform& T_world_sensor);

 private:
  Conversion& conversion_;
  const double min_distance_;
  pcrb::RateLimiter limiter_;
  std::optional<Eigen::Vector3d> last_;
};

}  // namespace pcrb_tools
