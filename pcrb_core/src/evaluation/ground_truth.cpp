#include "pcrb_core/evaluation/ground_truth.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "pcrb_core/error.hpp"

namespace pcrb {

std::vector<bool> findOutliers(const std::vector<double>& values) {
  constexpr double kNormalQuartile = 0.6745;  // MAD of the standard normal distribution
  constexpr double kLargestScore = 3.5;
  std::vector<bool> outliers(values.size(), false);
  if (values.empty()) return outliers;
  const double median = describe(values).median;
  std::vector<double> deviations;
  for (const double value : values) deviations.push_back(std::abs(value - median));
  const double mad = describe(deviations).median;
  for (std::size_t i = 0; i < values.size() && mad > 0.0; ++i) {
    outliers[i] = kNormalQuartile * (values[i] - median) / mad > kLargestScore;
  }
  return outliers;
}

GroundTruthAccuracy assessGroundTruth(const std::vector<double>& misalignments) {
  if (misalignments.empty()) {
    throw InvalidParameter("ground truth: found no misalignment, expected at least one");
  }
  for (const double misalignment : misalignments) {
    if (!(misalignment >= 0.0)) {
      throw InvalidParameter("ground truth: found a misalignment of " +
                             std::to_string(misalignment) + " m, expected at least 0");
    }
  }
  GroundTruthAccuracy accuracy;
  accuracy.is_outlier = findOutliers(misalignments);
  std::vector<double> kept;
  for (std::size_t i = 0; i < misalignments.size(); ++i) {
    if (accuracy.is_outlier[i]) {
      ++accuracy.outliers;
    } else {
      kept.push_back(misalignments[i]);
    }
  }
  accuracy.kept = describe(kept);
  return accuracy;
}

}  // namespace pcrb
