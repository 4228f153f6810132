#pragma once

#include <cstddef>
#include <vector>

#include "pcrb_core/evaluation/statistics.hpp"

namespace pcrb {

/// How accurate a sequence's ground truth is, from the misalignments of its pairs.
struct GroundTruthAccuracy {
  std::vector<bool> is_outlier;  ///< one per misalignment, in their order
  std::size_t outliers = 0;
  Statistics kept;  ///< of the others, m
};

/// Values above the others by far: 0.6745 (x − median) / MAD > 3.5 (modified z-score, one-sided),
/// MAD being the median of |x − median|. Where MAD is 0 there are none.
///
/// @param values  finite, in any order.
/// @return        one per value, in their order.
/// @throws InvalidParameter  if a value is not finite.
/// Source: Fontana et al. 2021, section 4; Iglewicz, Hoaglin, How to detect and handle outliers,
/// 1993.
std::vector<bool> findOutliers(const std::vector<double>& values);

/// Outliers, and the mean and standard deviation (with n) of the rest: a row of the paper's Table
/// 1.
///
/// @param misalignments  m, one per pair: the mean distance that a registration which starts at the
///                       ground truth moves the source's points.
/// @throws InvalidParameter  if one is negative or not finite, or there is none.
GroundTruthAccuracy assessGroundTruth(const std::vector<double>& misalignments);

}  // namespace pcrb
