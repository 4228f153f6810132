#include "pcrb_tools/conversion/conversion.hpp"

#include <filesystem>
#include <utility>

#include "pcrb_core/error.hpp"
#include "pcrb_core/problem/problem_file.hpp"
#include "pcrb_tools/interruption.hpp"

namespace pcrb_tools {
namespace {

/// Part of every fingerprint: raise it when the same log gives other bytes.
constexpr const char* kConverterVersion = "1";

}  // namespace

Conversion::Conversion(const ConversionRequest& request, const std::string& sequence,
                       std::size_t total_scans)
    : folder_(request.root, request.data_set, sequence),
      progress_(sequence, "scans", total_scans),
      drop_when_full_(request.drop_when_full),
      workers_(request.threads, request.max_waiting > 0
                                    ? request.max_waiting
                                    : static_cast<std::size_t>(request.threads)) {
  report_.sequence = sequence;
}

bool Conversion::wants(const std::string& cloud_name, const std::string& origin) {
  const std::string fingerprint = fingerprintOf(kConverterVersion + ('\n' + origin));
  const auto kept = folder_.kept(cloud_name, fingerprint);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!fingerprints_.emplace(cloud_name, fingerprint).second) {
    throw pcrb::InvalidFile(cloud_name, 0, "a second scan for this cloud", "one");
  }
  ++report_.scans_read;
  if (!kept) return true;
  report_.points += *kept;
  report_.written.insert(cloud_name);
  ++report_.scans_kept;
  progress_.keep(1);
  return false;
}

WorkerPool::Job Conversion::jobFor(const std::string& cloud_name, Make make) {
  Interruption::check();
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::string fingerprint = fingerprints_.at(cloud_name);
  return [this, cloud_name, fingerprint, make = std::move(make)] {
    const ConvertedScan scan = make();
    folder_.write(cloud_name, fingerprint, scan.cloud, scan.counts);
    const std::lock_guard<std::mutex> report_lock(mutex_);
    report_.points += scan.counts;
    report_.written.insert(cloud_name);
    progress_.add(1);
  };
}

void Conversion::add(const std::string& cloud_name, Make make) {
  WorkerPool::Job job = jobFor(cloud_name, std::move(make));
  if (!drop_when_full_) {
    workers_.submit(std::move(job));
  } else if (!workers_.trySubmit(job)) {
    const std::lock_guard<std::mutex> lock(mutex_);
    report_.dropped["came faster than it could be converted"].push_back(cloud_name);
  }
}

void Conversion::drop(const std::string& scan_name, const std::string& reason) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++report_.scans_read;
  report_.dropped[reason].push_back(scan_name);
  progress_.add(1);
}

ConversionReport Conversion::finish() {
  workers_.finish();
  Interruption::check();
  progress_.finish();
  if (report_.written.empty()) {
    throw pcrb::InvalidFile(folder_.path(), "no scan became a cloud\n" + formatReport(report_));
  }
  const auto others = folder_.othersThan(report_.written);
  if (!others.empty()) {
    report_.notes.push_back(std::to_string(others.size()) + " other clouds lie in " +
                            folder_.path() + ", the first is " + others.front());
  }
  return report_;
}

std::vector<std::string> describeMissingClouds(const ConversionRequest& request,
                                               const ConversionReport& report) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(request.root) / request.data_set / report.sequence;
  std::vector<std::string> lines;
  for (const char* kind : {"_local.txt", "_global.txt"}) {
    const fs::path file = folder.parent_path() / (report.sequence + kind);
    if (!fs::exists(file)) continue;
    std::set<std::string> missing;
    for (const auto& problem : pcrb::readProblemFile(file.string())) {
      for (const auto& name : {problem.source, problem.target}) {
        if (report.written.count(name) == 0 && !fs::exists(folder / name)) missing.insert(name);
      }
    }
    for (const auto& name : missing) {
      lines.push_back(file.filename().string() + " names " + name + ", which is not in " +
                      folder.string());
    }
  }
  return lines;
}

}  // namespace pcrb_tools
