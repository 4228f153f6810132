#include "pcrb_core/evaluation/rank_tests.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

constexpr double kNoCorrelation = std::numeric_limits<double>::quiet_NaN();

/// Pearson's correlation; NaN if one side does not vary.
double pearson(const std::vector<double>& x, const std::vector<double>& y) {
  const double n = static_cast<double>(x.size());
  const double mean_x = std::accumulate(x.begin(), x.end(), 0.0) / n;
  const double mean_y = std::accumulate(y.begin(), y.end(), 0.0) / n;
  double xx = 0.0, yy = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double dx = x[i] - mean_x, dy = y[i] - mean_y;
    xx += dx * dx;
    yy += dy * dy;
    xy += dx * dy;
  }
  if (xx == 0.0 || yy == 0.0) return kNoCorrelation;
  return std::clamp(xy / std::sqrt(xx * yy), -1.0, 1.0);
}

double twoSidedP(double rho, std::size_t count) {
  if (count < 3 || std::isnan(rho)) return kNoCorrelation;
  const double freedom = static_cast<double>(count - 2);
  const double rest = (1.0 - rho) * (1.0 + rho);
  if (rest == 0.0) return 0.0;
  const boost::math::students_t distribution(freedom);
  const double t = std::abs(rho) * std::sqrt(freedom / rest);
  return 2.0 * boost::math::cdf(boost::math::complement(distribution, t));
}

}  // namespace

std::vector<double> ranks(const std::vector<double>& values) {
  for (const double value : values) {
    if (std::isnan(value)) throw InvalidParameter("ranks: found NaN, expected numbers");
  }
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> result(values.size());
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    while (end < order.size() && values[order[end]] == values[order[begin]]) ++end;
    const double shared = static_cast<double>(begin + 1 + end) / 2.0;
    for (std::size_t i = begin; i < end; ++i) result[order[i]] = shared;
  }
  return result;
}

Correlation spearman(const std::vector<double>& x, const std::vector<double>& y) {
  if (x.size() != y.size()) {
    throw InvalidParameter("spearman: found " + std::to_string(x.size()) + " and " +
                           std::to_string(y.size()) + " values, expected pairs");
  }
  Correlation correlation;
  correlation.count = x.size();
  correlation.rho = x.size() < 2 ? kNoCorrelation : pearson(ranks(x), ranks(y));
  correlation.p_value = twoSidedP(correlation.rho, x.size());
  return correlation;
}

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

namespace {

/// A rank sum, doubled since shared ranks are halves, and its chances where each first of each
/// group is as likely.
struct RankSum {
  std::vector<double> chances{1.0};
  std::size_t observed = 0;
  std::size_t largest = 0;

  void add(const std::vector<double>& group_ranks);
  double chanceOf(std::size_t sum_at_least) const {
    return std::accumulate(chances.begin() + static_cast<std::ptrdiff_t>(sum_at_least),
                           chances.end(), 0.0);
  }
};

void RankSum::add(const std::vector<double>& group_ranks) {
  std::vector<double> next(chances.size() + 2 * group_ranks.size(), 0.0);
  for (const double rank : group_ranks) {
    const auto doubled = static_cast<std::size_t>(2.0 * rank);
    for (std::size_t sum = 0; sum < chances.size(); ++sum) {
      next[sum + doubled] += chances[sum] / static_cast<double>(group_ranks.size());
    }
  }
  chances = std::move(next);
  observed += static_cast<std::size_t>(2.0 * group_ranks.front());
  largest +=
      static_cast<std::size_t>(2.0 * *std::max_element(group_ranks.begin(), group_ranks.end()));
}

}  // namespace

OrderTest firstAgainstLater(const std::vector<std::vector<double>>& groups) {
  OrderTest test;
  RankSum sum;
  for (const std::vector<double>& group : groups) {
    if (group.size() < 2) continue;
    ++test.groups;
    sum.add(ranks(group));
  }
  test.p_value = std::min(1.0, sum.chanceOf(sum.observed));
  test.smallest_p = std::min(1.0, sum.chanceOf(sum.largest));
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
