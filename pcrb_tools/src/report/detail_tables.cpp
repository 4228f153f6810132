#include <algorithm>
#include <cmath>
#include <limits>

#include "pcrb_core/evaluation/distributions.hpp"
#include "pcrb_core/evaluation/statistics.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/transform.hpp"
#include "report/section_tables.hpp"

namespace pcrb_tools {
namespace {

std::vector<double> sortedTimes(const Problems& problems,
                                std::optional<double> ScoredProblem::*member, bool new_target) {
  std::vector<double> times;
  for (const ScoredProblem* problem : problems) {
    if (!problem->isAnswered() || (new_target && !problem->target_changed)) continue;
    if (problem->*member) times.push_back(*(problem->*member));
  }
  std::sort(times.begin(), times.end());
  return times;
}

std::vector<Json> runtimeRow(const Entry& entry, const Selection& selection) {
  const Problems problems = select(entry, selection);
  const auto latency = sortedTimes(problems, &ScoredProblem::runtime, false);
  const auto fresh = sortedTimes(problems, &ScoredProblem::runtime, true);
  const auto solver = sortedTimes(problems, &ScoredProblem::solver_time, false);
  if (latency.empty() && solver.empty()) return {};
  std::vector<Json> row{entry.method, selection.name, latency.size()};
  for (const double q : {0.05, 0.5, 0.95, 0.99, 1.0}) row.push_back(quantileOf(latency, q));
  row.push_back(quantileOf(fresh, 0.5));
  for (const double q : {0.5, 0.95}) row.push_back(quantileOf(solver, q));
  return row;
}

/// Errors of one component in m or degrees, ascending.
std::vector<double> sortedComponent(const Problems& problems, std::size_t axis) {
  std::vector<double> values;
  for (const ScoredProblem* problem : problems) {
    if (!problem->components || !problem->isAnswered()) continue;
    values.push_back(problem->components->at(axis) / (axis < 3 ? 1.0 : pcrb::kRadiansPerDegree));
  }
  std::sort(values.begin(), values.end());
  return values;
}

std::string limitName(const std::pair<double, double>& limit) {
  return pcrb::formatShortest(limit.first) + " m, " + pcrb::formatShortest(limit.second) + "°";
}

}  // namespace

Table recallTable(const Section& section, const ReportOptions& options) {
  Table table{"recall",
              "Registration recall",
              "Fraction of all problems that are answered with at most this translation error (of "
              "the source's centroid) and this rotation error.",
              {{"method"}, {"selection"}, {"problems", Format::kCount}},
              {}};
  for (const auto& limit : options.recall_limits) {
    table.columns.push_back({limitName(limit), Format::kFraction});
  }
  for (const Entry* entry : section.withBaseline()) {
    for (const Selection& selection : section.selections) {
      const auto outcomes = outcomesForSuccess(select(*entry, selection));
      if (outcomes.empty()) continue;
      std::vector<Json> row{entry->method, selection.name, outcomes.size()};
      for (const auto& [translation, degrees] : options.recall_limits) {
        row.push_back(number(
            pcrb::registrationRecall(outcomes, translation, degrees * pcrb::kRadiansPerDegree)));
      }
      if (!row.back().is_null()) table.rows.push_back(std::move(row));
    }
  }
  return table;
}

Table runtimeTable(const Section& section) {
  Table table{
      "runtimes",
      "Time to a reply",
      "Quantiles in s over answered problems. Latency: from the source's publication to the "
      "reply; new target: the same where the target had just changed; solver: as the client "
      "says.",
      {{"method"}, {"selection"}, {"replies", Format::kCount}},
      {}};
  for (const char* name :
       {"q05", "median", "q95", "q99", "max", "new target", "solver median", "solver q95"}) {
    table.columns.push_back({name, Format::kSeconds});
  }
  for (const Entry* entry : section.entries) {
    for (const Selection* selection : section.at({"sequence", "total"})) {
      auto row = runtimeRow(*entry, *selection);
      if (!row.empty()) table.rows.push_back(std::move(row));
    }
  }
  return table;
}

Table componentTable(const Section& section) {
  Table table{"components",
              "Errors along and about each axis",
              "Of answered problems: translation of the source's centroid (m) and roll, pitch, yaw "
              "(degrees), in the axes of the data set. median shows a bias, q05 to q95 the spread.",
              {{"method"}, {"selection"}, {"axis"}, {"replies", Format::kCount}},
              {}};
  for (const char* name : {"q05", "q25", "median", "q75", "q95"}) {
    table.columns.push_back({name, Format::kError});
  }
  for (const Entry* entry : section.withBaseline()) {
    for (const Selection* selection : section.at({"sequence", "total"})) {
      const Problems problems = select(*entry, *selection);
      for (std::size_t axis = 0; axis < 6; ++axis) {
        const auto values = sortedComponent(problems, axis);
        if (values.empty()) continue;
        const char* const names[] = {"x", "y", "z", "roll", "pitch", "yaw"};
        std::vector<Json> row{entry->method, selection->name, names[axis], values.size()};
        for (const double q : {0.05, 0.25, 0.5, 0.75, 0.95}) row.push_back(quantileOf(values, q));
        table.rows.push_back(std::move(row));
      }
    }
  }
  return table;
}

Table problemTable(const Section& section) {
  Table table{"problems",
              "Problems, worst first",
              "Every problem of every method.",
              {{"method"},
               {"sequence"},
               {"error", Format::kError},
               {"outcome"},
               {"misalignment", Format::kError},
               {"translation m", Format::kError},
               {"rotation deg", Format::kError},
               {"overlap", Format::kFraction},
               {"latency", Format::kSeconds},
               {"NEES", Format::kError},
               {"problem"},
               {"source"},
               {"target"},
               {"reason"}},
              {}};
  std::vector<std::pair<const Entry*, const ScoredProblem*>> order;
  for (const Entry* entry : section.entries) {
    for (const ScoredProblem& problem : entry->problems) order.emplace_back(entry, &problem);
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.second->error > b.second->error; });
  for (const auto& [entry, problem] : order) {
    std::optional<double> degrees = problem->rotation_error;
    if (degrees) *degrees /= pcrb::kRadiansPerDegree;
    table.rows.push_back(
        {entry->method, sequenceName(section, problem->key), problem->error,
         pcrb::toString(problem->outcome), number(problem->initial_misalignment),
         number(problem->translation_error), number(degrees), number(problem->overlap),
         number(problem->runtime), problem->judged ? number(problem->judged->nees) : Json(nullptr),
         problem->key.problem_id, problem->source, problem->target, problem->reason});
  }
  return table;
}

}  // namespace pcrb_tools
