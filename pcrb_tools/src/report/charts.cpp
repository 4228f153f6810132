#include <algorithm>

#include "pcrb_core/evaluation/distributions.hpp"
#include "pcrb_core/evaluation/statistics.hpp"
#include "pcrb_core/problem/pair_sampling.hpp"
#include "report/section_tables.hpp"

namespace pcrb_tools {
namespace {

constexpr std::size_t kHistogramBins = 40;
constexpr std::size_t kQuantileBins = 8;

Json solvedCurves(const Section& section, const std::vector<double>& thresholds) {
  Json curves = Json::array();
  for (const Entry* entry : section.withBaseline()) {
    Json curve;
    curve["method"] = entry->method;
    curve["fractions"] = pcrb::fractionSolved(
        outcomesForSuccess(select(*entry, *section.at({"total"}).front())), thresholds);
    curves.push_back(curve);
  }
  return curves;
}

Json toJson(const std::vector<pcrb::QuantileBin>& bins) {
  Json list = Json::array();
  for (const pcrb::QuantileBin& bin : bins) {
    Json described;
    described["low"] = bin.low;
    described["high"] = bin.high;
    described["count"] = bin.count;
    described["q25"] = bin.q25;
    described["median"] = bin.median;
    described["q75"] = bin.q75;
    list.push_back(described);
  }
  return list;
}

Json binnedErrors(const Section& section, std::optional<double> ScoredProblem::*property) {
  Json panels = Json::array();
  for (const Selection* selection : section.at({"data set"})) {
    Json panel;
    panel["selection"] = selection->name;
    panel["methods"] = Json::array();
    for (const Entry* entry : section.withBaseline()) {
      std::vector<double> x, y;
      for (const ScoredProblem* problem : select(*entry, *selection)) {
        if (!(problem->*property)) continue;
        x.push_back(*(problem->*property));
        y.push_back(problem->error);
      }
      if (x.empty()) continue;
      Json method;
      method["method"] = entry->method;
      method["bins"] = toJson(pcrb::binnedQuantiles(x, y, kQuantileBins));
      panel["methods"].push_back(method);
    }
    if (!panel["methods"].empty()) panels.push_back(panel);
  }
  return panels;
}

/// Where a selection's histograms end: beyond the 0.95 quantile of every method.
double histogramEnd(const Section& section, const Selection& selection) {
  double end = 0.0;
  for (const Entry* entry : section.entries) {
    const auto errors = errorsOf(select(*entry, selection));
    if (!errors.empty()) end = std::max(end, pcrb::describe(errors).q95);
  }
  return end > 0.0 ? 1.1 * end : 1.0;
}

Json histogramJson(const std::string& method, const std::vector<double>& errors, double end) {
  const pcrb::Histogram histogram = pcrb::makeHistogram(errors, 0.0, end, kHistogramBins);
  const pcrb::Statistics statistics = pcrb::describe(errors);
  Json json;
  json["method"] = method;
  json["max"] = histogram.max;
  json["counts"] = histogram.counts;
  json["above"] = histogram.above;
  json["median"] = number(statistics.median);
  json["mean"] = number(statistics.mean);
  json["stddev"] = number(statistics.stddev);
  return json;
}

Json histograms(const Section& section) {
  Json panels = Json::array();
  for (const Selection* selection : section.at({"sequence", "total"})) {
    const double end = histogramEnd(section, *selection);
    Json panel;
    panel["selection"] = selection->name;
    panel["methods"] = Json::array();
    for (const Entry* entry : section.withBaseline()) {
      const auto errors = errorsOf(select(*entry, *selection));
      if (!errors.empty()) panel["methods"].push_back(histogramJson(entry->method, errors, end));
    }
    panels.push_back(panel);
  }
  return panels;
}

/// Overlaps of a sequence's pairs of clouds: those of its problem file where it is known, else each
/// pair that a method had, once.
std::vector<double> overlapsOf(const Section& section, const Selection& selection) {
  const auto known = section.overlaps.find(*selection.sequences.begin());
  if (known != section.overlaps.end()) return known->second;
  return overlapsOfProblems(section, selection);
}

/// What the ten intervals cut: the range that pairs were drawn from, else that of the pairs.
pcrb::Range overlapRangeOf(const Section& section, const Selection& selection,
                           const std::vector<double>& overlaps) {
  const auto [least, most] = std::minmax_element(overlaps.begin(), overlaps.end());
  pcrb::Range range{*least, *most};
  const auto known = section.overlap_ranges.find(*selection.sequences.begin());
  if (known != section.overlap_ranges.end()) {
    range = {std::min(known->second.min, *least), std::max(known->second.max, *most)};
  }
  constexpr double kLeastWidth = 1e-3;  // of pairs that all have one overlap
  return {range.min, std::max(range.max, range.min + kLeastWidth)};
}

Json overlapHistograms(const Section& section) {
  Json panels = Json::array();
  for (const Selection* selection : section.at({"sequence"})) {
    const auto overlaps = overlapsOf(section, *selection);
    if (overlaps.empty()) continue;
    Json panel;
    panel["selection"] = selection->name;
    panel["pairs"] = overlaps.size();
    const pcrb::Range range = overlapRangeOf(section, *selection, overlaps);
    panel["low"] = range.min;
    panel["high"] = range.max;
    panel["counts"] =
        pcrb::makeHistogram(overlaps, range.min, range.max, pcrb::kOverlapIntervals).counts;
    panel["median"] = pcrb::describe(overlaps).median;
    panels.push_back(panel);
  }
  return panels;
}

}  // namespace

Json chartsOf(const Section& section) {
  const std::vector<double> thresholds = pcrb::logarithmicSteps(1e-3, 10.0, 81);
  Json charts;
  charts["thresholds"] = thresholds;
  charts["solved"] = solvedCurves(section, thresholds);
  charts["over_misalignment"] = binnedErrors(section, &ScoredProblem::initial_misalignment);
  charts["over_overlap"] = binnedErrors(section, &ScoredProblem::overlap);
  charts["over_scans"] = errorsOverScans(section);
  charts["histograms"] = histograms(section);
  charts["overlaps"] = overlapHistograms(section);
  charts["calibration"] = calibrationCurves(section);
  return charts;
}

}  // namespace pcrb_tools
