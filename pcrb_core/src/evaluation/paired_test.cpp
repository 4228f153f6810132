#include "pcrb_core/evaluation/paired_test.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "pcrb_core/error.hpp"
#include "pcrb_core/evaluation/correlation.hpp"

namespace pcrb {
namespace {

constexpr std::size_t kLargestExact = 50;

/// P(rank sum <= statistic) where signs are coins: the subsets of the ranks by their sum. Mid-ranks
/// of ties are halves, so all is doubled.
double exactTail(const std::vector<double>& rank, double statistic) {
  std::vector<double> subsets(rank.size() * (rank.size() + 1) + 1, 0.0);  // up to 2^50: exact
  subsets[0] = 1.0;
  for (const double one : rank) {
    const std::size_t doubled = static_cast<std::size_t>(2.0 * one);
    for (std::size_t sum = subsets.size(); sum-- > doubled;) subsets[sum] += subsets[sum - doubled];
  }
  double tail = 0.0;
  for (std::size_t sum = 0; sum <= static_cast<std::size_t>(2.0 * statistic); ++sum) {
    tail += subsets[sum];
  }
  return std::ldexp(tail, -static_cast<int>(rank.size()));
}

/// Σ (t³ − t) over groups of t equal magnitudes.
double tieTerm(std::vector<double> magnitudes) {
  std::sort(magnitudes.begin(), magnitudes.end());
  double term = 0.0;
  for (std::size_t begin = 0, end = 0; begin < magnitudes.size(); begin = end) {
    while (end < magnitudes.size() && magnitudes[end] == magnitudes[begin]) ++end;
    const double t = static_cast<double>(end - begin);
    term += t * t * t - t;
  }
  return term;
}

double approximateP(double n, double statistic, double ties) {
  const double mean = n * (n + 1.0) / 4.0;
  const double variance = n * (n + 1.0) * (2.0 * n + 1.0) / 24.0 - ties / 48.0;
  return std::erfc(std::abs(statistic - mean) / std::sqrt(2.0 * variance));
}

double average(double a, double b) { return 0.5 * a + 0.5 * b; }

/// Number of averages of two values, or of one with itself, that are at most `limit`.
std::size_t averagesUpTo(const std::vector<double>& sorted, double limit) {
  std::size_t count = 0, end = sorted.size();
  for (std::size_t first = 0; first < end; ++first) {
    while (end > first && average(sorted[first], sorted[end - 1]) > limit) --end;
    count += end - first;
  }
  return count;
}

/// The average at a place (from 0) in the order of all, by bisection: there are too many to list.
double averageAt(const std::vector<double>& sorted, std::size_t place) {
  double low = sorted.front(), high = sorted.back();
  for (double middle = average(low, high); low < middle && middle < high;
       middle = average(low, high)) {
    (averagesUpTo(sorted, middle) > place ? high : low) = middle;
  }
  return averagesUpTo(sorted, low) > place ? low : high;
}

double pseudomedian(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t count = values.size() * (values.size() + 1) / 2;
  return average(averageAt(values, (count - 1) / 2), averageAt(values, count / 2));
}

/// Differences that are not zero.
std::vector<double> nonzeroOf(const std::vector<double>& differences) {
  std::vector<double> nonzero;
  for (const double difference : differences) {
    if (!std::isfinite(difference)) {
      throw InvalidParameter("wilcoxon: found " + std::to_string(difference) +
                             ", expected finite differences");
    }
    if (difference != 0.0) nonzero.push_back(difference);
  }
  return nonzero;
}

}  // namespace

PairedTest wilcoxon(const std::vector<double>& differences) {
  const std::vector<double> nonzero = nonzeroOf(differences);
  PairedTest test;
  test.count = nonzero.size();
  if (nonzero.empty()) return test;
  std::vector<double> magnitudes;
  for (const double difference : nonzero) magnitudes.push_back(std::abs(difference));
  const std::vector<double> rank = ranks(magnitudes);
  for (std::size_t i = 0; i < nonzero.size(); ++i) {
    (nonzero[i] > 0.0 ? test.positive : test.negative) += rank[i];
  }
  test.pseudomedian = pseudomedian(nonzero);
  const double statistic = std::min(test.positive, test.negative);
  const double p = nonzero.size() <= kLargestExact
                       ? 2.0 * exactTail(rank, statistic)
                       : approximateP(static_cast<double>(nonzero.size()), statistic,
                                      tieTerm(std::move(magnitudes)));
  test.p_value = std::min(1.0, p);
  return test;
}

std::vector<double> holmAdjusted(const std::vector<double>& p_values) {
  for (const double p : p_values) {
    if (!(p >= 0.0 && p <= 1.0)) {
      throw InvalidParameter("holm: found " + std::to_string(p) + ", expected p-values in [0, 1]");
    }
  }
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return p_values[a] < p_values[b]; });
  std::vector<double> adjusted(p_values.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double factor = static_cast<double>(order.size() - i);
    largest = std::max(largest, std::min(1.0, factor * p_values[order[i]]));
    adjusted[order[i]] = largest;
  }
  return adjusted;
}

}  // namespace pcrb
