#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "pcrb_core/datasets/sensor_scan.hpp"

namespace pcrb {

// The Canadian Planetary Emulation Terrain 3D Mapping data set (Tong et al., IJRR 2013).

/// Fraction of a scan's lines that may be no point, if not said otherwise: more is another format.
constexpr double kMaxMalformed = 0.01;

/// So many lines may be malformed in any scan, e.g. a header.
constexpr std::size_t kFewMalformedLines = 10;

/// Reads an `.xyz` file: one point a line, x y z separated by blanks, metres, sensor frame.
///
/// Lines that are not three numbers are left out and counted as malformed; blank lines are not
/// counted.
/// @param name           stands for the path in messages
/// @param max_malformed  fraction of the lines that may be malformed; kFewMalformedLines always may
/// @throws InvalidFile  if no line is a point, or more lines than that are malformed.
SensorScan parsePlanetaryScan(std::string_view text, const std::string& name,
                              double max_malformed = kMaxMalformed);

/// Reads a `.gt` file: T_world_sensor, 4 × 4, row-major, with blank lines anywhere.
///
/// The file has six decimals, so the rotation is replaced by the nearest one.
/// @throws InvalidFile  unless it is 16 numbers in four rows, the last 0 0 0 1, with a rotation
///                      (1e-3).
Transform parsePlanetaryPose(std::string_view text, const std::string& name);

}  // namespace pcrb
