#include <algorithm>
#include <map>

#include "pcrb_core/evaluation/statistics.hpp"
#include "pcrb_core/run/convergence_monitor.hpp"
#include "report/section_tables.hpp"

namespace pcrb_tools {
namespace {

using Scans = std::vector<pcrb::ScanRecord>;

/// What a rule makes of a selection's stored answers.
struct RuleScore {
  std::vector<double> errors, scans;
  std::size_t settled = 0, worse = 0;
};

RuleScore scoreOf(const pcrb::AcceptanceRule& rule, const Problems& problems) {
  RuleScore score;
  for (const ScoredProblem* problem : problems) {
    const pcrb::RuleReplay replay = pcrb::replayRule(rule, problem->scans);
    if (replay.answer == nullptr || !replay.answer->error) continue;
    score.errors.push_back(*replay.answer->error);
    score.scans.push_back(replay.answer->scan);
    score.settled += replay.is_settled ? 1 : 0;
    score.worse += *replay.answer->error > problem->initial_misalignment.value_or(0.0) ? 1 : 0;
  }
  return score;
}

const std::map<std::string, pcrb::AcceptanceRule::Kind>& shownRules() {
  using Kind = pcrb::AcceptanceRule::Kind;
  static const std::map<std::string, Kind> rules{
      {"1 first", Kind::kFirst}, {"2 stable", Kind::kStable}, {"3 deadline", Kind::kDeadline}};
  return rules;
}

/// Scans that were sent and not answered, and s from a scan to its answer.
struct ScanTimes {
  std::size_t sent = 0, unanswered = 0;
  std::vector<double> latencies;
};

ScanTimes timesOf(const Problems& problems) {
  ScanTimes times;
  for (const ScoredProblem* problem : problems) {
    times.sent += problem->scans.size();
    for (const pcrb::ScanRecord& record : problem->scans) {
      if (record.answered) {
        times.latencies.push_back(*record.answered - record.sent);
      } else {
        ++times.unanswered;
      }
    }
  }
  std::sort(times.latencies.begin(), times.latencies.end());
  return times;
}

/// s of processor time for each s between a problem's source and its reply.
Json processorShare(const Entry& entry) {
  double elapsed = 0.0;
  for (const ScoredProblem& problem : entry.problems) elapsed += problem.runtime.value_or(0.0);
  const double used = entry.info ? entry.info->node_cpu_time : 0.0;
  return used > 0.0 && elapsed > 0.0 ? Json(used / elapsed) : Json(nullptr);
}

/// The error that a problem had after a scan: of the newest answer until then.
std::optional<double> errorAfter(const Scans& scans, std::uint32_t scan) {
  std::optional<double> error;
  for (const pcrb::ScanRecord& record : scans) {
    if (record.scan <= scan && record.error && !record.is_echo) error = record.error;
  }
  return error;
}

Json scanBin(const Problems& problems, std::uint32_t scan) {
  std::vector<double> errors;
  for (const ScoredProblem* problem : problems) {
    if (const auto error = errorAfter(problem->scans, scan)) errors.push_back(*error);
  }
  if (errors.empty()) return nullptr;
  std::sort(errors.begin(), errors.end());
  Json bin;
  bin["low"] = scan - 0.5;
  bin["high"] = scan + 0.5;
  bin["count"] = errors.size();
  bin["q25"] = pcrb::quantile(errors, 0.25);
  bin["median"] = pcrb::quantile(errors, 0.5);
  bin["q75"] = pcrb::quantile(errors, 0.75);
  return bin;
}

Json scanCurve(const Entry& entry, const Selection& selection) {
  const Problems problems = select(entry, selection);
  std::uint32_t last = 0;
  for (const ScoredProblem* problem : problems) {
    if (!problem->scans.empty()) last = std::max(last, problem->scans.back().scan);
  }
  Json bins = Json::array();
  for (std::uint32_t scan = 1; scan <= last; ++scan) {
    Json bin = scanBin(problems, scan);
    if (!bin.is_null()) bins.push_back(std::move(bin));
  }
  return bins;
}

}  // namespace

Table settlingTable(const Section& section) {
  Table table{
      "settling",
      "What each rule makes of the answers",
      "Of localization nodes whose answers to all scans are stored: the answer that `first`, "
      "`stable` (three in a row within 0.01 m and 0.002 rad) or `deadline` (the last one) "
      "takes. A run ends a problem by its own rule, and no rule sees an answer after that: "
      "settle:=deadline shows all of them in full. worse: than doing nothing.",
      {{"method"},
       {"selection"},
       {"rule"},
       {"answered", Format::kCount},
       {"settled", Format::kCount},
       {"worse", Format::kCount},
       {"scans", Format::kError}},
      {}};
  for (const char* name : {"median", "q75", "q95"}) table.columns.push_back({name, Format::kError});
  for (const Entry* entry : section.entries) {
    for (const Selection* selection : section.at({"sequence", "total"})) {
      for (const auto& [name, kind] : shownRules()) {
        pcrb::AcceptanceRule rule;
        rule.kind = kind;
        const RuleScore score = scoreOf(rule, select(*entry, *selection));
        if (score.errors.empty()) continue;
        const pcrb::Statistics errors = pcrb::describe(score.errors);
        table.rows.push_back({entry->method, selection->name, name.substr(2), score.errors.size(),
                              score.settled, score.worse, pcrb::describe(score.scans).median,
                              errors.median, errors.q75, errors.q95});
      }
    }
  }
  return table;
}

Table keepingUpTable(const Section& section) {
  Table table{"keeping_up",
              "Scans and their answers",
              "Of localization nodes: scans that were sent, those without an answer (dropped, or "
              "refused by the node), s from a scan to its answer, and the share of one processor "
              "that the node used while it had problems, over the whole run.",
              {{"method"},
               {"selection"},
               {"scans", Format::kCount},
               {"unanswered", Format::kCount},
               {"median", Format::kSeconds},
               {"q95", Format::kSeconds},
               {"processor", Format::kFraction}},
              {}};
  for (const Entry* entry : section.entries) {
    for (const Selection* selection : section.at({"sequence", "total"})) {
      const ScanTimes times = timesOf(select(*entry, *selection));
      if (times.sent == 0) continue;
      const bool is_total = selection->level == "total";
      table.rows.push_back({entry->method, selection->name, times.sent, times.unanswered,
                            quantileOf(times.latencies, 0.5), quantileOf(times.latencies, 0.95),
                            is_total ? processorShare(*entry) : Json(nullptr)});
    }
  }
  return table;
}

Json errorsOverScans(const Section& section) {
  Json panels = Json::array();
  for (const Selection* selection : section.at({"sequence"})) {
    Json panel;
    panel["selection"] = selection->name;
    panel["methods"] = Json::array();
    for (const Entry* entry : section.entries) {
      Json bins = scanCurve(*entry, *selection);
      if (!bins.empty()) panel["methods"].push_back({{"method", entry->method}, {"bins", bins}});
    }
    if (!panel["methods"].empty()) panels.push_back(panel);
  }
  return panels;
}

}  // namespace pcrb_tools
