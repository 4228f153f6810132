#include <algorithm>
#include <filesystem>
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

bool namesSequence(const std::string& word, const std::string& data_set,
                   const std::string& sequence) {
  return word == "all" || word == sequence || word == data_set || word == data_set + "/" + sequence;
}

}  // namespace pcrb
