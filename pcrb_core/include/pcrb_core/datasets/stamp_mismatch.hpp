#pragma once

#include <string>
#include <vector>

#include "pcrb_core/datasets/stamp.hpp"

namespace pcrb {

/// Says why no scan has a pose in time: both time ranges, the smallest difference, and a guess:
/// another unit (ns for s), an index for a time, or clocks that differ by a constant.
///
/// @param scans  stamps, not empty
/// @param poses  stamps, ascending, not empty
std::string describeMismatch(const std::vector<Stamp>& scans, const std::vector<Stamp>& poses);

}  // namespace pcrb
