#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "pcrb_core/datasets/sensor_scan.hpp"
#include "pcrb_core/datasets/stamp.hpp"

namespace pcrb {

/// How the clouds of a folder are read.
struct CloudFileOptions {
  OriginPoints origin = OriginPoints::kKeep;
  std::size_t bin_fields = 4;  ///< float32 numbers of a point in a `.bin`; x y z come first
};

/// Whether a file name ends like a cloud that parseCloudFile() reads: .pcd, .ply, .bin, .npy, in
/// any case.
bool isCloudFileName(std::string_view file_name);

/// The stamp that a scan's file is named by, alone or behind the last `_`:
/// `1311878220.377686160.pcd` in seconds, `urban05_1524185042111111111.pcd` in ns; nothing for
/// other names.
std::optional<Stamp> stampOfFileName(std::string_view file_name);

/// Reads a cloud in the format that its name ends with.
///
/// PCD: as readPcd(). PLY: ascii, or binary in either byte order, with x y z as float or double in
/// its vertices. `.bin`: records of little-endian float32 without header, as KITTI and nuScenes
/// have them. `.npy`: an array of N × 3 or more (or rows × columns × 3 or more) float32 or float64,
/// or of records with fields x y z. The time of points is read where vertices or
/// records have a field of one of the names in pointTimeScale().
/// @param name  stands for the path in messages
/// @throws InvalidFile  for defects, with what was found and what was expected; for a `.bin` whose
///                      values are no points of a lidar: its records have another length.
SensorScan parseCloudFile(std::string_view bytes, const std::string& name,
                          const CloudFileOptions& options);

SensorScan parsePly(std::string_view bytes, OriginPoints origin, const std::string& name);
SensorScan parseNpy(std::string_view bytes, OriginPoints origin, const std::string& name);

}  // namespace pcrb
