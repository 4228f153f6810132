#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "pcrb_core/datasets/sensor_scan.hpp"
#include "pcrb_core/datasets/trajectory.hpp"

namespace pcrb {

// The KAIST urban data set (Jeong et al., IJRR 2019): two VLP-16 on a car, ground truth in UTM.

/// Reads a `<ns>.bin` scan: records of four little-endian float32, x y z intensity, sensor frame.
/// @param name  stands for the path in messages
/// @throws InvalidFile  if the size is not a multiple of 16; if more than a hundredth of the
/// records
///                      (and ten) hold what such a scanner does not give, a coordinate beyond 1 km
///                      or a negative intensity: they have another length.
SensorScan parseVelodyneScan(std::string_view bytes, OriginPoints origin, const std::string& name);

/// Reads `VLP_left_stamp.csv` or `VLP_right_stamp.csv`: one stamp in ns a line.
/// @throws InvalidFile  with line, what was found and what was expected.
std::vector<Stamp> parseKaistStamps(std::string_view text, const std::string& name);

/// Reads `Vehicle2LeftVLP.txt` or `Vehicle2RightVLP.txt`: T_vehicle_sensor (despite the name:
/// p_vehicle = R p + T), the rotation as written.
/// @throws InvalidFile  unless there are exactly one line `R:` with the 9 numbers of a rotation
///                      (1e-3) and one line `T:` with 3.
Transform parseKaistCalibration(std::string_view text, const std::string& name);

/// Reads `global_pose.csv`: `ns,r00,r01,r02,tx,r10,…,tz`, T_world_vehicle in UTM, the rotations as
/// written.
/// @throws InvalidFile  with line, what was found and what was expected; if there is no pose.
Trajectory parseKaistTrajectory(std::string_view text, const std::string& name);

/// The stamp closest to `stamp`, the earlier one of two at the same distance.
/// @param stamps  ascending, not empty
Stamp closestStamp(const std::vector<Stamp>& stamps, Stamp stamp);

/// How the scans of a log become clouds.
struct KaistOptions {
  bool interpolate = false;           ///< poses: between the two around instead of the closest one
  Stamp max_pose_gap = kSecond / 10;  ///< to the closest pose, or between the two around
  Stamp max_pair_gap = kSecond / 10;  ///< between the left and the right scan
  Eigen::Vector3d frame_offset = Eigen::Vector3d::Zero();  ///< m, added to UTM coordinates
};

/// T_world_vehicle for a scan, frame offset included.
PoseLookup kaistPose(const Trajectory& trajectory, Stamp stamp, const KaistOptions& options);

/// A scan and the poses that place it.
struct PlacedScan {
  SensorScan scan;
  Transform T_world_vehicle = Transform::Identity();
  Transform T_vehicle_sensor = Transform::Identity();
};

/// The cloud of two scans: left points, then right points, each through its own pose; the viewpoint
/// is the left sensor's pose.
DatasetCloud mergeScans(PlacedScan left, PlacedScan right);

/// The sequence that a folder or an archive is named after, or empty: `urban05` for
/// `urban05-highway` and `urban05_data.tgz`.
std::string kaistSequenceName(std::string_view file_name);

/// `urban05_1524211208123456789.pcd`
std::string kaistCloudName(const std::string& sequence, Stamp left_stamp);

}  // namespace pcrb
