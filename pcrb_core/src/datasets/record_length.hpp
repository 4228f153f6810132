#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "pcrb_core/datasets/sensor_scan.hpp"

namespace pcrb {

/// Looks whether the values of a file without a header speak for another number of float32 numbers
/// in a record than it was read with: then all its numbers are mixed, and nothing else would say
/// so.
///
/// @param scan  as read
/// @throws InvalidFile  if coordinates are none of a lidar, or other records make more sense.
void requireLikelyLength(std::string_view bytes, std::size_t fields, const SensorScan& scan,
                         const std::string& name);

}  // namespace pcrb
