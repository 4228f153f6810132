#include "pcrb_core/evaluation/success.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double fraction(std::size_t part, std::size_t whole) {
  return whole == 0 ? kNaN : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

std::vector<double> fractionSolved(const std::vector<Attempt>& attempts,
                                   const std::vector<double>& thresholds) {
  if (!std::is_sorted(thresholds.begin(), thresholds.end())) {
    throw InvalidParameter("fraction solved: expected ascending thresholds");
  }
  std::vector<double> errors;
  for (const Attempt& attempt : attempts) {
    if (attempt.is_answered) errors.push_back(attempt.error);
  }
  std::sort(errors.begin(), errors.end());
  std::vector<double> fractions;
  for (const double threshold : thresholds) {
    const auto end = std::upper_bound(errors.begin(), errors.end(), threshold);
    fractions.push_back(fraction(static_cast<std::size_t>(end - errors.begin()), attempts.size()));
  }
  return fractions;
}

double registrationRecall(const std::vector<Attempt>& attempts, double translation,
                          double rotation) {
  std::size_t solved = 0;
  for (const Attempt& attempt : attempts) {
    if (!attempt.is_answered) continue;
    if (std::isnan(attempt.translation_error) || std::isnan(attempt.rotation_error)) return kNaN;
    if (attempt.translation_error <= translation && attempt.rotation_error <= rotation) ++solved;
  }
  return fraction(solved, attempts.size());
}

std::vector<double> logarithmicSteps(double low, double high, std::size_t count) {
  if (!(low > 0.0 && low < high && std::isfinite(high)) || count < 2) {
    throw InvalidParameter("logarithmic steps: expected 0 < low < high and at least two steps");
  }
  std::vector<double> steps;
  const double ratio = std::log(high / low) / static_cast<double>(count - 1);
  for (std::size_t i = 0; i < count; ++i) {
    steps.push_back(low * std::exp(ratio * static_cast<double>(i)));
  }
  steps.back() = high;
  return steps;
}

}  // namespace pcrb
