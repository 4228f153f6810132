#include <algorithm>
#include <filesystem>

#include "pcrb_core/io/derived_file.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"
#include "pcrb_core/problem/problem.hpp"
#include "report/published.hpp"
#include "report/section.hpp"

namespace pcrb_tools {
namespace {

constexpr std::uint64_t kProblemsPerPair = 31;  // 30 local ones and a global one
constexpr std::size_t kPublishedDigits = 4;     // of 31 · 100 - 1 and of 31 · 102 - 1

/// The digits of an official id that follow those of its sequence; empty if it is none.
std::string indexOf(const pcrb::ProblemKey& key) {
  const std::string first = pcrb::problemId(key.sequence, 0, 1);  // with an index of two digits
  const std::string prefix = first.substr(0, first.size() - 2);
  return pcrb::startsWith(key.problem_id, prefix) ? key.problem_id.substr(prefix.size())
                                                  : std::string();
}

using SequenceKey = std::pair<std::string, std::string>;  // data set, sequence

bool isDrawn(const Entry& entry, const SequenceKey& key, const std::string& root) {
  const std::string name = key.first + "/" + key.second + "_" + pcrb::toString(entry.kind) + ".txt";
  if (entry.info && entry.info->drawn_by.count(name) > 0) return true;
  const std::string path = root + "/" + name;
  if (root.empty() || !std::filesystem::is_regular_file(path)) return false;
  const bool is_known = entry.info && entry.info->problem_files.count(name) > 0;
  const std::string hash = is_known ? entry.info->problem_files.at(name) : pcrb::fileHash(path);
  return !pcrb::generatorOf(path, hash).empty();
}

}  // namespace

std::string pairOf(const ScoredProblem& problem) {
  const std::string sequence = problem.key.data_set + "/" + problem.key.sequence + " ";
  if (!problem.source.empty()) return sequence + problem.source + " " + problem.target;
  const auto index = pcrb::parseUnsigned(indexOf(problem.key));
  if (index) return sequence + "pair " + std::to_string(*index / kProblemsPerPair);
  return sequence + "problem " + problem.key.problem_id;
}

bool hasPublishedId(const pcrb::ProblemKey& key) {
  const std::string index = indexOf(key);
  return index.size() == kPublishedDigits && pcrb::parseUnsigned(index);
}

std::set<SequenceKey> findOwnProblems(const std::vector<const Entry*>& entries,
                                      const std::string& root) {
  std::set<SequenceKey> own;
  for (const Entry* entry : entries) {
    std::set<SequenceKey> sequences;
    for (const ScoredProblem& problem : entry->problems) {
      const SequenceKey key{problem.key.data_set, problem.key.sequence};
      sequences.insert(key);
      if (isInPaper(key.first, key.second) && !hasPublishedId(problem.key)) own.insert(key);
    }
    for (const SequenceKey& key : sequences) {
      if (isDrawn(*entry, key, root)) own.insert(key);
    }
  }
  return own;
}

std::string namesOfOwnProblems(const Section& section) {
  std::string names;
  for (const Selection* selection : section.at({"sequence"})) {
    if (section.own_problems.count(*selection->sequences.begin()) == 0) continue;
    names += (names.empty() ? "" : ", ") + selection->name;
  }
  return names;
}

std::string publishedRowOf(const Section& section, const Selection& selection) {
  const bool is_published = std::all_of(
      selection.sequences.begin(), selection.sequences.end(), [&](const SequenceKey& key) {
        return isInPaper(key.first, key.second) && section.own_problems.count(key) == 0;
      });
  if (!is_published) return {};
  if (selection.level == "sequence") return selection.sequences.begin()->second;
  const bool is_complete = selection.sequences.size() == paperSequenceCount();
  return selection.level == "total" && is_complete ? "total" : "";
}

}  // namespace pcrb_tools
