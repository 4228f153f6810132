#include "pcrb_core/evaluation/binned_quantiles.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pcrb_core/error.hpp"
#include "pcrb_core/evaluation/statistics.hpp"

namespace pcrb {
namespace {

using Points = std::vector<std::pair<double, double>>;  // x and y, ascending

QuantileBin describeBin(const Points& points, std::size_t begin, std::size_t end) {
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
  Points points;
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

}  // namespace pcrb
