#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <set>

#include "pcrb_core/evaluation/rank_tests.hpp"
#include "pcrb_core/evaluation/statistics.hpp"
#include "report/section_tables.hpp"

namespace pcrb_tools {
namespace {

constexpr std::size_t kWorstPerMethod = 10;

/// The methods, and the baseline, where it has all problems that these have.
std::vector<const Entry*> rankedEntries(const Section& section) {
  std::set<pcrb::ProblemKey> keys;
  for (const Entry* entry : section.entries) {
    for (const ScoredProblem& problem : entry->problems) keys.insert(problem.key);
  }
  const bool is_known = section.baseline && section.baseline->problems.size() == keys.size();
  return is_known ? section.withBaseline() : section.entries;
}

/// Each method's median error of each pair of clouds, over the problems that all methods have.
std::vector<std::vector<double>> mediansByPair(const std::vector<const Entry*>& entries) {
  const std::size_t methods = entries.size();
  struct Shared {
    std::string pair;
    std::vector<std::vector<double>> errors;  // of all trials
  };
  std::map<pcrb::ProblemKey, Shared> by_problem;
  for (std::size_t i = 0; i < methods; ++i) {
    for (const ScoredProblem& problem : entries[i]->problems) {
      Shared& shared = by_problem[problem.key];
      shared.pair = problem.pair;
      shared.errors.resize(methods);
      shared.errors[i].push_back(problem.error);
    }
  }
  std::map<std::string, std::vector<std::vector<double>>> by_pair;
  for (const auto& [key, shared] : by_problem) {
    const auto lacks = [](const std::vector<double>& errors) { return errors.empty(); };
    if (std::any_of(shared.errors.begin(), shared.errors.end(), lacks)) continue;
    auto& errors = by_pair[shared.pair];
    errors.resize(methods);
    for (std::size_t i = 0; i < methods; ++i) {
      errors[i].insert(errors[i].end(), shared.errors[i].begin(), shared.errors[i].end());
    }
  }
  std::vector<std::vector<double>> medians;
  for (const auto& [pair, errors] : by_pair) {
    medians.emplace_back();
    for (const auto& values : errors) medians.back().push_back(pcrb::describe(values).median);
  }
  return medians;
}

struct Ranked {
  std::string method;
  double rank;
};

std::vector<Ranked> meanRanks(const std::vector<const Entry*>& entries,
                              const std::vector<std::vector<double>>& medians) {
  std::vector<Ranked> ranked;
  for (const Entry* entry : entries) ranked.push_back({entry->method, 0.0});
  for (const auto& row : medians) {
    const std::vector<double> ranks = pcrb::ranks(row);
    for (std::size_t i = 0; i < ranks.size(); ++i) {
      ranked[i].rank += ranks[i];
    }
  }
  for (Ranked& entry : ranked) entry.rank /= static_cast<double>(medians.size());
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const Ranked& a, const Ranked& b) { return a.rank < b.rank; });
  return ranked;
}

/// Pairs of methods whose difference over all problems is real, either way round.
std::set<std::pair<std::string, std::string>> realDifferences(const Table& comparisons) {
  std::set<std::pair<std::string, std::string>> real;
  const TableReader reader(comparisons);
  for (const auto& row : comparisons.rows) {
    if (reader.text(row, "selection") != "total" || reader.text(row, "better").empty()) continue;
    const std::string a = reader.text(row, "a"), b = reader.text(row, "b");
    real.emplace(a, b);
    real.emplace(b, a);
  }
  return real;
}

/// Neighbours in the ranking none of which is shown to differ from any other.
Json cliquesOf(const std::vector<Ranked>& ranked, const Table& comparisons) {
  const auto real = realDifferences(comparisons);
  Json cliques = Json::array();
  std::size_t covered = 0;
  for (std::size_t first = 0; first < ranked.size(); ++first) {
    std::size_t end = first + 1;
    const auto differs = [&](const Ranked& member) {
      return real.count({member.method, ranked[end].method}) > 0;
    };
    while (end < ranked.size() &&
           std::none_of(ranked.begin() + static_cast<std::ptrdiff_t>(first),
                        ranked.begin() + static_cast<std::ptrdiff_t>(end), differs)) {
      ++end;
    }
    if (end - first < 2 || end <= covered) continue;
    covered = end;
    Json clique = Json::array();
    for (std::size_t i = first; i < end; ++i) clique.push_back(ranked[i].method);
    cliques.push_back(clique);
  }
  return cliques;
}

std::string quotedForShell(const std::string& text) {
  const auto is_plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string("/._-=+:,@").find(c) != std::string::npos;
  };
  if (!text.empty() && std::all_of(text.begin(), text.end(), is_plain)) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// What shows a problem of a run, and nothing else.
std::string replayCommand(const Entry& entry, const ScoredProblem& problem) {
  const pcrb::ProblemKey& key = problem.key;
  const auto trial = entry.trial_folders.find(problem.trial);
  const std::string& folder = trial == entry.trial_folders.end() ? entry.path : trial->second;
  const std::string run = std::filesystem::absolute(folder).lexically_normal();
  return "pcrb replay --run " + quotedForShell(run) + " --sequences " +
         quotedForShell(key.data_set + "/" + key.sequence) + " --kind " + toString(key.kind) +
         " --problem " + quotedForShell(key.problem_id) + " --rviz";
}

Json describeWorst(const Section& section, const Entry& entry, const ScoredProblem& problem) {
  Json json;
  json["sequence"] = sequenceName(section, problem.key);
  json["problem"] = problem.key.problem_id;
  json["error"] = problem.error;
  json["misalignment"] = number(problem.initial_misalignment);
  json["outcome"] = pcrb::toString(problem.outcome);
  json["command"] = entry.info ? Json(replayCommand(entry, problem)) : Json(nullptr);
  return json;
}

}  // namespace

Json rankingOf(const Section& section, const Table& comparisons) {
  constexpr std::size_t kFewestMethods = 3;
  const auto entries = rankedEntries(section);
  const auto medians = mediansByPair(entries);
  if (section.entries.size() < kFewestMethods || medians.empty()) return nullptr;
  const std::vector<Ranked> ranked = meanRanks(entries, medians);
  Json json;
  json["pairs"] = medians.size();
  json["methods"] = Json::array();
  for (const Ranked& entry : ranked) {
    json["methods"].push_back(Json{{"method", entry.method}, {"rank", entry.rank}});
  }
  json["cliques"] = cliquesOf(ranked, comparisons);
  return json;
}

Json errorsAgainstTimes(const Table& scores, const Table& runtimes) {
  const TableReader score(scores), runtime(runtimes);
  Json list = Json::array();
  for (const auto& row : runtimes.rows) {
    const auto time = runtime.number(row, "median");
    if (runtime.text(row, "selection") != "total" || !time) continue;
    for (const auto& other : scores.rows) {
      if (score.text(other, "level") != "total" || score.text(other, "selection") != "total" ||
          score.text(other, "method") != runtime.text(row, "method")) {
        continue;
      }
      Json json;
      json["method"] = runtime.text(row, "method");
      json["time"] = *time;
      json["q05"] = *runtime.number(row, "q05");
      json["q95"] = *runtime.number(row, "q95");
      for (const char* name : {"median", "low", "high"}) json[name] = score.cell(other, name);
      list.push_back(json);
    }
  }
  for (Json& json : list) {
    const double time = json["time"], error = json["median"];
    json["is_front"] = std::none_of(list.begin(), list.end(), [&](const Json& other) {
      const double t = other["time"], e = other["median"];
      return t <= time && e <= error && (t < time || e < error);
    });
  }
  return list;
}

Json worstProblems(const Section& section) {
  Json list = Json::array();
  for (const Entry* entry : section.entries) {
    Problems problems;
    for (const ScoredProblem& problem : entry->problems) problems.push_back(&problem);
    std::stable_sort(problems.begin(), problems.end(),
                     [](const auto* a, const auto* b) { return a->error > b->error; });
    if (problems.size() > kWorstPerMethod) problems.resize(kWorstPerMethod);
    Json json;
    json["method"] = entry->method;
    json["problems"] = Json::array();
    for (const ScoredProblem* problem : problems) {
      json["problems"].push_back(describeWorst(section, *entry, *problem));
    }
    list.push_back(json);
  }
  return list;
}

}  // namespace pcrb_tools
