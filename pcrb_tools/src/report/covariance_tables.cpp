#include <string>
#include <vector>

#include "pcrb_core/evaluation/covariance_consistency.hpp"
#include "report/section_tables.hpp"

namespace pcrb_tools {
namespace {

constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;

/// Of some problems: those whose covariance could be judged.
struct JudgedProblems {
  std::vector<pcrb::JudgedCovariance> judged;
  std::vector<std::size_t> units;
  std::size_t with_covariance = 0;
};

JudgedProblems judgedOf(const Entry& entry, const Selection& selection) {
  JudgedProblems result;
  Problems problems;
  for (const ScoredProblem* problem : select(entry, selection)) {
    // Without components the truth was not looked for: nothing is known of the covariance.
    result.with_covariance += problem->covariance && problem->components ? 1 : 0;
    if (problem->judged) problems.push_back(problem);
  }
  for (const ScoredProblem* problem : problems) result.judged.push_back(*problem->judged);
  result.units = unitsOf(problems);
  return result;
}

/// No fields where no reply came with a covariance.
std::vector<Json> covarianceRow(const Entry& entry, const Selection& selection) {
  const JudgedProblems problems = judgedOf(entry, selection);
  if (problems.with_covariance == 0) return {};
  std::vector<Json> row{entry.method, selection.name, problems.judged.size(),
                        problems.with_covariance - problems.judged.size()};
  if (problems.judged.empty()) {
    row.insert(row.end(), 8, nullptr);
    row.emplace_back("no matrix is a covariance");
    return row;
  }
  const pcrb::Calibration c = pcrb::calibrate(problems.judged, problems.units);
  for (const double value : {c.mean_ratio, c.median_ratio}) row.push_back(number(value));
  for (const pcrb::Proportion& inside : {c.inside_50, c.inside_95}) {
    for (const double v : {inside.value, inside.low, inside.high}) row.push_back(number(v));
  }
  row.emplace_back(c.verdict);
  return row;
}

}  // namespace

Table covarianceTable(const Section& section) {
  Table table{
      "covariances",
      "Covariances",
      "Whether errors are as large as the covariances that came with the replies say. NEES: "
      "eᵀ C⁻¹ e over the axes that have a variance; mean: divided by their number, 1 is "
      "right, more is overconfident; median: divided by the median of its χ², which a few "
      "failures do not move. inside 50 % and 95 %: fraction of the errors within these "
      "ellipsoids, with the 95 % interval of as many trials as there are pairs of clouds. "
      "not judged: matrices that are no covariance (not symmetric or not positive definite).",
      {{"method"},
       {"selection"},
       {"judged", Format::kCount},
       {"not judged", Format::kCount},
       {"mean NEES", Format::kError},
       {"median NEES", Format::kError},
       {"inside 50 %", Format::kFraction},
       {"low 50", Format::kFraction},
       {"high 50", Format::kFraction},
       {"inside 95 %", Format::kFraction},
       {"low 95", Format::kFraction},
       {"high 95", Format::kFraction},
       {"verdict"}},
      {}};
  for (const Entry* entry : section.entries) {
    for (const Selection* selection : section.at({"sequence", "total"})) {
      auto row = covarianceRow(*entry, *selection);
      if (!row.empty()) table.rows.push_back(std::move(row));
    }
  }
  return table;
}

Table covarianceAxisTable(const Section& section) {
  Table table{
      "covariance_axes",
      "Covariances of each axis",
      "Axes of the frame that the replies are in. stated: the median σ (m, degrees); rms: of "
      "errors divided by their σ, 1 is right, more is overconfident; inside: fraction of the "
      "errors within ± 0.674 σ and ± 1.960 σ, which is 50 % and 95 % of right ones.",
      {{"method"},
       {"axis"},
       {"replies", Format::kCount},
       {"stated", Format::kError},
       {"rms", Format::kError},
       {"inside 50 %", Format::kFraction},
       {"inside 95 %", Format::kFraction}},
      {}};
  const char* const names[] = {"x", "y", "z", "rx", "ry", "rz"};
  for (const Entry* entry : section.entries) {
    const auto judged = judgedOf(*entry, *section.at({"total"}).front()).judged;
    for (std::size_t axis = 0; axis < 6; ++axis) {
      const pcrb::AxisCalibration c = pcrb::calibrateAxis(judged, axis);
      if (c.count == 0) continue;
      const double stated = axis < 3 ? c.median_deviation : c.median_deviation / kRadiansPerDegree;
      table.rows.push_back({entry->method, names[axis], c.count, number(stated),
                            number(c.rms_normalized), number(c.inside_50), number(c.inside_95)});
    }
  }
  return table;
}

Json calibrationCurves(const Section& section) {
  std::vector<double> probabilities;
  for (int i = 0; i <= 40; ++i) probabilities.push_back(i / 40.0);
  Json curves = Json::array();
  for (const Entry* entry : section.entries) {
    const auto judged = judgedOf(*entry, *section.at({"total"}).front()).judged;
    if (judged.empty()) continue;
    Json curve;
    curve["method"] = entry->method;
    curve["fractions"] = pcrb::calibrationCurve(judged, probabilities);
    curves.push_back(curve);
  }
  Json json;
  json["probabilities"] = probabilities;
  json["curves"] = curves;
  return json;
}

}  // namespace pcrb_tools
