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

bool isToBeChecked(const std::vector<std::string>& wanted, const SequenceFiles& files) {
  if (wanted.empty()) return true;
  return std::any_of(wanted.begin(), wanted.end(), [&](const std::string& word) {
    return pcrb::namesSequence(word, {files.data_set, files.sequence});
  });
}

std::vector<SequenceFiles> findWanted(const CheckOptions& options) {
  std::vector<SequenceFiles> found = pcrb::findSequences(options.root);
  if (found.empty()) {
    throw pcrb::InvalidFile(options.root, 0, "no problem file",
                            "<data set>/<sequence>_local.txt or _global.txt");
  }
  for (const std::string& name : options.sequences) {
    if (std::none_of(found.begin(), found.end(),
                     [&](const SequenceFiles& files) { return isToBeChecked({name}, files); })) {
      throw pcrb::InvalidParameter("found no problem file of '" + name + "' below " + options.root);
    }
  }
  found.erase(std::remove_if(found.begin(), found.end(),
                             [&](const SequenceFiles& files) {
                               return !isToBeChecked(options.sequences, files);
                             }),
              found.end());
  return found;
}

/// Folders of clouds that no problem file uses, and sequences with one list only.
std::vector<Finding> checkLayout(const std::string& root, const std::vector<SequenceFiles>& all) {
  std::vector<Finding> findings;
  std::set<std::string> used;
  std::map<std::string, std::set<pcrb::Kind>> kinds;
  std::set<std::string> data_sets;
  for (const SequenceFiles& files : all) {
    used.insert(fs::path(files.cloud_folder).filename().string());
    kinds[root + "/" + files.data_set + "/" + files.sequence].insert(files.kind);
    data_sets.insert(files.data_set);
  }
  for (const auto& [sequence, some] : kinds) {
    if (some.size() == 2) continue;
    const bool has_local = *some.begin() == pcrb::Kind::kLocal;
    findings.push_back(
        {Severity::kNote, sequence + (has_local ? "_local.txt" : "_global.txt"),
         std::string("has no ") + (has_local ? "global" : "local") + " list beside it"});
  }
  for (const std::string& data_set : data_sets) {
    for (const auto& entry : fs::directory_iterator(root + "/" + data_set)) {
      const std::string name = entry.path().filename().string();
      if (!entry.is_directory() || used.count(name) > 0) continue;
      findings.push_back({Severity::kNote, entry.path().string(), "no problem file uses it"});
    }
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
  const std::vector<SequenceFiles> wanted = findWanted(options);
  Report report(out);
  const bool is_all = options.sequences.empty() ||
                      std::count(options.sequences.begin(), options.sequences.end(), "all") > 0;
  if (is_all) report.add(checkLayout(options.root, wanted));
  FolderCache folders(report, options.threads);
  for (const SequenceFiles& files : wanted) checkFile(files, options, folders, report);
  report.printSummary(wanted.size(), folders.clouds());
  return report.count(Severity::kError) == 0 &&
         (!options.strict || report.count(Severity::kWarning) == 0);
}

}  // namespace pcrb_tools
