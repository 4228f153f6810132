#include "report/own_problems.hpp"

#include <algorithm>
#include <filesystem>

#include "pcrb_core/io/derived_file.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/problem/problem.hpp"
#include "report/published.hpp"

namespace pcrb_tools {
namespace {

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
