#include "pcrb_core/evaluation/correlation.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

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
  if (xx == 0.0 || yy == 0.0) return kNaN;
  return std::clamp(xy / std::sqrt(xx * yy), -1.0, 1.0);
}

double twoSidedP(double rho, std::size_t count) {
  if (count < 3 || std::isnan(rho)) return kNaN;
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
  correlation.rho = x.size() < 2 ? kNaN : pearson(ranks(x), ranks(y));
  correlation.p_value = twoSidedP(correlation.rho, x.size());
  return correlation;
}

}  // namespace pcrb
