#pragma once

#include <functional>

#include "pcrb_core/datasets/sensor_scan.hpp"
#include "pcrb_core/datasets/trajectory.hpp"

namespace pcrb {

/// T_dataset_sensor over time, e.g. interpolated in a trajectory.
using PoseAt = std::function<PoseLookup(Stamp)>;

/// When a point was measured.
///
/// @param time  s: after the scan's stamp (before it where negative), or since 1970 where that is
///              what its size says, then also in ms, µs or ns.
/// @return      a stamp beyond all logs for what is no time, e.g. NaN.
Stamp pointStamp(Stamp scan, double time);

/// The scan in the data set's frame, each point moved by the sensor's pose at its own time: a
/// lidar that moves while it turns bends what it sees. The viewpoint is the pose at the scan's
/// stamp.
///
/// @param scan  with the times of its points
/// @param cloud  set where the status is kFound
/// @return      why there is no cloud: the poses end before the scan does, or have a gap in it.
PoseStatus placeMovingScan(const SensorScan& scan, Stamp stamp, const PoseAt& pose_at,
                           DatasetCloud& cloud);

}  // namespace pcrb
