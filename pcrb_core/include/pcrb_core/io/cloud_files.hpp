#pragma once

#include <string>
#include <vector>

namespace pcrb {

/// Order of file names as a person counts: runs of digits compare as numbers, so `PointCloud2.pcd`
/// comes before `PointCloud10.pcd`. Names that differ in leading zeros only compare as text.
bool naturalLess(const std::string& left, const std::string& right);

/// Names of the `.pcd` files in a folder (hidden ones left out), in natural order.
///
/// @throws InvalidFile  if the path is no readable folder.
std::vector<std::string> findClouds(const std::string& folder);

}  // namespace pcrb
