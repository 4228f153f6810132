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

/// P(rank sum <= statistic) for n differences whose signs are coins: the subsets of {1 … n} by sum.
double exactTail(std::size_t n, std::size_t statistic) {
  std::vector<double> subsets(n * (n + 1) / 2 + 1, 0.0);  // whole numbers up to 2^50: exact
  subsets[0] = 1.0;
  for (std::size_t rank = 1; rank <= n; ++rank) {
    for (std::size_t sum = subsets.size(); sum-- > rank;) subsets[sum] += subsets[sum - rank];
  }
  double tail = 0.0;
  for (std::size_t sum = 0; sum <= statistic; ++sum) tail += subsets[sum];
  return std::ldexp(tail, -static_cast<int>(n));
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

}  // namespace

PairedTest wilcoxon(const std::vector<double>& differences) {
  std::vector<double> magnitudes, nonzero;
  for (const double difference : differences) {
    if (!std::isfinite(difference)) {
      throw InvalidParameter("wilcoxon: found " + std::to_string(difference) +
                             ", expected finite differences");
    }
    if (difference == 0.0) continue;
    nonzero.push_back(difference);
    magnitudes.push_back(std::abs(difference));
  }
  PairedTest test;
  test.count = nonzero.size();
  if (nonzero.empty()) return test;
  const std::vector<double> rank = ranks(magnitudes);
  double positive = 0.0, negative = 0.0;
  for (std::size_t i = 0; i < nonzero.size(); ++i) {
    (nonzero[i] > 0.0 ? positive : negative) += rank[i];
  }
  test.statistic = std::min(positive, negative);
  const double ties = tieTerm(magnitudes);
  const bool is_exact =
      ties == 0.0 && nonzero.size() == differences.size() && nonzero.size() <= kLargestExact;
  const double p = is_exact
                       ? 2.0 * exactTail(nonzero.size(), static_cast<std::size_t>(test.statistic))
                       : approximateP(static_cast<double>(nonzero.size()), test.statistic, ties);
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
