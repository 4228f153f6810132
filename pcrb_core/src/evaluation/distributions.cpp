#include "pcrb_core/evaluation/distributions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "pcrb_core/error.hpp"
#include "pcrb_core/evaluation/statistics.hpp"

namespace pcrb {

Histogram makeHistogram(const std::vector<double>& values, double min, double max,
                        std::size_t bins) {
  if (!std::isfinite(min) || !std::isfinite(max) || !(min < max) || bins == 0) {
    throw InvalidParameter("histogram: expected min < max, both finite, and at least one bin");
  }
  Histogram histogram;
  histogram.min = min;
  histogram.max = max;
  histogram.counts.assign(bins, 0);
  for (const double value : values) {
    if (std::isnan(value)) throw InvalidParameter("histogram: found NaN, expected numbers");
    if (value < min) {
      ++histogram.below;
    } else if (value > max) {
      ++histogram.above;
    } else {
      const double position = (value - min) / (max - min) * static_cast<double>(bins);
      ++histogram.counts[std::min(static_cast<std::size_t>(position), bins - 1)];
    }
  }
  return histogram;
}

namespace {

using SortedPairs = std::vector<std::pair<double, double>>;  // x and y, ascending

QuantileBin describeBin(const SortedPairs& points, std::size_t begin, std::size_t end) {
  std::vector<double> values;
  for (std::size_t i = begin; i < end; ++i) values.push_back(points[i].second);
  std::sort(values.begin(), values.end());
  QuantileBin bin;
  bin.low = points[begin].first;
  bin.high = end < points.size() ? points[end].first : points.back().first;
  bin.count = values.size();
  bin.q25 = quantile(values, 0.25);
  bin.median = quantile(values, 0.5);
  bin.q75 = quantile(values, 0.75);
  return bin;
}

}  // namespace

std::vector<QuantileBin> binnedQuantiles(const std::vector<double>& x, const std::vector<double>& y,
                                         std::size_t bins) {
  if (x.size() != y.size() || bins == 0) {
    throw InvalidParameter("binned quantiles: expected pairs of values and at least one bin");
  }
  SortedPairs points;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i])) {
      throw InvalidParameter("binned quantiles: expected finite values");
    }
    points.emplace_back(x[i], y[i]);
  }
  std::sort(points.begin(), points.end());
  std::vector<QuantileBin> result;
  std::size_t begin = 0;
  for (std::size_t bin = 1; bin <= bins; ++bin) {
    std::size_t end = points.size() * bin / bins;
    while (end > begin && end < points.size() && points[end].first == points[end - 1].first) ++end;
    if (end <= begin) continue;
    result.push_back(describeBin(points, begin, end));
    begin = end;
  }
  return result;
}

namespace {

constexpr double kNoFraction = std::numeric_limits<double>::quiet_NaN();

double fraction(std::size_t part, std::size_t whole) {
  return whole == 0 ? kNoFraction : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

std::vector<double> fractionSolved(const std::vector<ProblemOutcome>& attempts,
                                   const std::vector<double>& thresholds) {
  if (!std::is_sorted(thresholds.begin(), thresholds.end())) {
    throw InvalidParameter("fraction solved: expected ascending thresholds");
  }
  std::vector<double> errors;
  for (const ProblemOutcome& attempt : attempts) {
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

double registrationRecall(const std::vector<ProblemOutcome>& attempts, double translation,
                          double rotation) {
  std::size_t solved = 0;
  for (const ProblemOutcome& attempt : attempts) {
    if (!attempt.is_answered) continue;
    if (std::isnan(attempt.translation_error) || std::isnan(attempt.rotation_error))
      return kNoFraction;
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
