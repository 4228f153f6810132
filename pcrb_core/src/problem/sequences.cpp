#include <algorithm>
#include <filesystem>
#include <set>
#include <tuple>
#include <utility>

#include "pcrb_core/error.hpp"
#include "pcrb_core/problem/dataset.hpp"

namespace pcrb {

namespace {

namespace fs = std::filesystem;

/// The published sequence whose clouds are another's scans, and that one.
constexpr const char* kMapSequence = "planetary_map";
constexpr const char* kMapSequenceFolder = "p2at_met";

std::vector<fs::path> entriesOf(const fs::path& folder) {
  std::error_code error;
  fs::directory_iterator iterator(folder, error);
  if (error) throw InvalidFile(folder.string(), "cannot read the folder: " + error.message());
  std::vector<fs::path> entries;
  for (const fs::directory_iterator end; iterator != end;) {
    entries.push_back(iterator->path());
    iterator.increment(error);
    if (error) throw InvalidFile(folder.string(), "cannot read the folder: " + error.message());
  }
  return entries;
}

/// Adds the file if its name is that of a problem file of this kind.
void addIfProblemFile(const fs::path& file, Kind kind, std::vector<SequenceFiles>& sequences) {
  const std::string name = file.filename().string();
  const std::string suffix = std::string("_") + toString(kind) + ".txt";
  if (name.size() <= suffix.size() || name.front() == '.') return;
  const std::size_t stem = name.size() - suffix.size();
  if (name.compare(stem, suffix.size(), suffix) != 0) return;
  SequenceFiles sequence;
  sequence.data_set = file.parent_path().filename().string();
  sequence.sequence = name.substr(0, stem);
  sequence.kind = kind;
  sequence.problem_file = file.string();
  const bool is_map = sequence.sequence == kMapSequence;
  sequence.cloud_folder =
      (file.parent_path() / (is_map ? kMapSequenceFolder : sequence.sequence)).string();
  sequences.push_back(std::move(sequence));
}

/// Every known name once, each after a blank; says so where there is none.
std::string listOf(const std::vector<SequenceName>& known) {
  std::set<std::string> names;
  for (const SequenceName& name : known) names.insert(name.data_set + "/" + name.sequence);
  std::string text;
  for (const std::string& name : names) text += " " + name;
  return text.empty() ? " there is none" : text;
}

}  // namespace

std::vector<SequenceFiles> findSequences(const std::string& root) {
  std::vector<SequenceFiles> sequences;
  for (const fs::path& data_set : entriesOf(root)) {
    std::error_code ignored;  // a dangling link is no folder
    if (!fs::is_directory(data_set, ignored) || data_set.filename().string().front() == '.')
      continue;
    for (const fs::path& file : entriesOf(data_set)) {
      for (const Kind kind : {Kind::kLocal, Kind::kGlobal}) addIfProblemFile(file, kind, sequences);
    }
  }
  const auto key = [](const SequenceFiles& files) {
    return std::tie(files.data_set, files.sequence, files.kind);
  };
  std::sort(sequences.begin(), sequences.end(),
            [&](const auto& a, const auto& b) { return key(a) < key(b); });
  return sequences;
}

bool namesSequence(const std::string& word, const SequenceName& name) {
  return word == "all" || word == name.sequence || word == name.data_set ||
         word == name.data_set + "/" + name.sequence;
}

std::vector<std::size_t> selectNamed(const std::vector<SequenceName>& known,
                                     const std::vector<std::string>& words,
                                     const std::function<void(const std::string& word)>& refuse) {
  if (words.empty()) return selectNamed(known, {"all"}, [](const std::string&) {});
  std::set<std::size_t> selected;
  for (const std::string& word : words) {
    bool is_used = false;
    for (std::size_t i = 0; i < known.size(); ++i) {
      if (!namesSequence(word, known[i])) continue;
      selected.insert(i);
      is_used = true;
    }
    if (!is_used) refuse(word);
  }
  return {selected.begin(), selected.end()};
}

std::vector<std::size_t> selectSequences(const std::vector<SequenceName>& known,
                                         const std::vector<std::string>& words,
                                         const std::string& place) {
  if (words.empty()) return {};
  return selectNamed(known, words, [&](const std::string& word) {
    throw InvalidParameter("sequences: found `" + word +
                           "`, expected `all`, a sequence, a data set or data_set/sequence " +
                           place + ":" + listOf(known));
  });
}

std::vector<SequenceFiles> selectProblemFiles(const std::string& root,
                                              const std::vector<std::string>& words,
                                              const std::vector<Kind>& kinds) {
  std::vector<SequenceFiles> files = findSequences(root);
  files.erase(std::remove_if(files.begin(), files.end(),
                             [&](const SequenceFiles& file) {
                               return std::find(kinds.begin(), kinds.end(), file.kind) ==
                                      kinds.end();
                             }),
              files.end());
  std::vector<SequenceName> names;
  for (const SequenceFiles& file : files) names.push_back({file.data_set, file.sequence});
  std::vector<SequenceFiles> selected;
  for (const std::size_t i :
       selectSequences(names, words, "with problems of the asked kind below " + root)) {
    selected.push_back(files[i]);
  }
  return selected;
}

}  // namespace pcrb
