#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "common/process.hpp"
#include "common/progress.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/problem/dataset_check.hpp"
#include "preparation/preparation_tools.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;
using pcrb::Finding;
using pcrb::SequenceFiles;
using pcrb::Severity;

/// Prints findings and counts them.
class Report {
 public:
  explicit Report(std::ostream& out) : out_(out) {}

  void add(const std::vector<Finding>& findings) {
    for (const Finding& finding : findings) {
      ++counts_[finding.severity];
      out_ << toString(finding.severity) << ": ";
      if (!finding.file.empty()) out_ << finding.file << ": ";
      out_ << finding.what << "\n";
    }
    out_.flush();
  }

  std::size_t count(Severity severity) const {
    const auto found = counts_.find(severity);
    return found == counts_.end() ? 0 : found->second;
  }

  void printSummary(std::size_t files, std::size_t clouds) const {
    out_ << files << " problem files, " << clouds << " clouds: " << count(Severity::kError)
         << " errors, " << count(Severity::kWarning) << " warnings, " << count(Severity::kNote)
         << " notes" << std::endl;
  }

 private:
  std::ostream& out_;
  std::map<Severity, std::size_t> counts_;
};

/// What there is to check below a root, by `<data set>/<sequence>`.
struct Contents {
  std::vector<SequenceFiles> files;
  std::vector<pcrb::SequenceName> bare;  ///< folders that no problem file uses
};

bool hasClouds(const std::string& folder) { return !pcrb::findClouds(folder).empty(); }

Contents findContents(const std::string& root) {
  Contents contents;
  contents.files = pcrb::findSequences(root);
  std::set<fs::path> used;
  std::set<std::string> with_problems;
  for (const SequenceFiles& files : contents.files) {
    used.insert(fs::path(files.cloud_folder));
    with_problems.insert(files.data_set);
  }
  for (const auto& data_set : fs::directory_iterator(root)) {
    if (!data_set.is_directory()) continue;
    const std::string name = data_set.path().filename().string();
    for (const auto& entry : fs::directory_iterator(data_set)) {
      if (!entry.is_directory() || used.count(entry.path()) > 0) continue;
      if (with_problems.count(name) > 0 || hasClouds(entry.path().string())) {
        contents.bare.push_back({name, entry.path().filename().string()});
      }
    }
  }
  std::sort(contents.bare.begin(), contents.bare.end(), [](const auto& a, const auto& b) {
    return std::pair(a.data_set, a.sequence) < std::pair(b.data_set, b.sequence);
  });
  return contents;
}

pcrb::SequenceName nameOf(const SequenceFiles& files) { return {files.data_set, files.sequence}; }

/// Takes away what is not wanted; every word must name something.
Contents selectWanted(const CheckOptions& options) {
  const Contents contents = findContents(options.root);
  if (contents.files.empty() && contents.bare.empty()) {
    throw pcrb::InvalidFile(options.root, 0, "no problem file and no clouds",
                            "<data set>/<sequence>_local.txt or _global.txt, or folders of .pcd");
  }
  std::vector<pcrb::SequenceName> names = contents.bare;
  std::transform(contents.files.begin(), contents.files.end(), std::back_inserter(names), nameOf);
  Contents wanted;
  const std::size_t bare_count = contents.bare.size();
  for (const std::size_t i :
       pcrb::selectNamed(names, options.sequences, [&](const std::string& word) {
         throw pcrb::InvalidParameter("found no problem file and no clouds of '" + word +
                                      "' below " + options.root);
       })) {
    if (i < bare_count) {
      wanted.bare.push_back(contents.bare[i]);
    } else {
      wanted.files.push_back(contents.files[i - bare_count]);
    }
  }
  return wanted;
}

/// Sequences with one list only.
std::vector<Finding> checkLists(const std::string& root, const std::vector<SequenceFiles>& all) {
  std::vector<Finding> findings;
  std::map<std::string, std::set<pcrb::Kind>> kinds;
  for (const SequenceFiles& files : all) {
    kinds[root + "/" + files.data_set + "/" + files.sequence].insert(files.kind);
  }
  for (const auto& [sequence, some] : kinds) {
    if (some.size() == 2) continue;
    const bool has_local = *some.begin() == pcrb::Kind::kLocal;
    findings.push_back(
        {Severity::kNote, sequence + (has_local ? "_local.txt" : "_global.txt"),
         std::string("has no ") + (has_local ? "global" : "local") + " list beside it"});
  }
  return findings;
}

/// Clouds of a folder are read once for all of its problem files.
class FolderCache {
 public:
  FolderCache(Report& report, int threads) : report_(report), threads_(threads) {}

  const pcrb::CloudSummaries& summaries(const std::string& folder) {
    const auto [found, is_new] = summaries_.try_emplace(folder);
    if (!is_new) return found->second;
    if (!fs::is_directory(folder)) {
      report_.add({{Severity::kError, folder, "is no folder"}});
      return found->second;
    }
    Progress progress(fs::path(folder).filename().string(), "clouds",
                      pcrb::findClouds(folder).size());
    const std::vector<Finding> findings = pcrb::checkClouds(folder, threads_, found->second, [&] {
      progress.add();
      Interruption::check();
    });
    progress.finish();
    report_.add(findings);
    clouds_ += found->second.size();
    return found->second;
  }

  std::size_t clouds() const { return clouds_; }

 private:
  Report& report_;
  int threads_;
  std::map<std::string, pcrb::CloudSummaries> summaries_;
  std::size_t clouds_ = 0;
};

void checkFile(const SequenceFiles& files, const CheckOptions& options, FolderCache& folders,
               Report& report) {
  const pcrb::Dataset dataset = pcrb::loadDataset(options.root, files.data_set);
  const pcrb::CloudSummaries& summaries = folders.summaries(files.cloud_folder);
  const std::vector<Finding> findings = checkProblems(files, dataset, summaries);
  report.add(findings);
  const bool is_malformed = findings.size() == 1 && findings.front().file.empty();
  if (!is_malformed) report.add(checkOverlaps(files, dataset, summaries, options.overlap_pairs));
}

}  // namespace

bool runCheckTool(const CheckOptions& options, std::ostream& out) {
  const Contents wanted = selectWanted(options);
  Report report(out);
  const bool is_all = options.sequences.empty() ||
                      std::count(options.sequences.begin(), options.sequences.end(), "all") > 0;
  if (is_all) report.add(checkLists(options.root, wanted.files));
  FolderCache folders(report, options.threads);
  for (const SequenceFiles& files : wanted.files) checkFile(files, options, folders, report);
  for (const auto& [data_set, sequence] : wanted.bare) {
    const std::string folder = options.root + "/" + data_set + "/" + sequence;
    report.add({{Severity::kNote, folder, "no problem file uses it"}});
    pcrb::loadDataset(options.root, data_set);  // its parameters must be readable
    if (hasClouds(folder)) folders.summaries(folder);
  }
  report.printSummary(wanted.files.size(), folders.clouds());
  return report.count(Severity::kError) == 0 &&
         (!options.strict || report.count(Severity::kWarning) == 0);
}

}  // namespace pcrb_tools
