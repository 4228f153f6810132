#include "conversion/conversion.hpp"

#include <filesystem>
#include <utility>

#include "common/interruption.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/problem/problem.hpp"

namespace pcrb_tools {
namespace {

/// Part of every fingerprint: raise it when the same log gives other bytes.
constexpr const char* kConverterVersion = "2";

}  // namespace

Conversion::Conversion(const ConversionRequest& request, const std::string& sequence,
                       std::size_t total_scans)
    : folder_(request.root, request.data_set, sequence),
      progress_(sequence, "scans", total_scans),
      live_(request.live),
      force_(request.force),
      workers_(request.threads, request.max_waiting > 0
                                    ? request.max_waiting
                                    : static_cast<std::size_t>(request.threads)) {
  report_.sequence = sequence;
}

bool Conversion::wants(const std::string& cloud_name, const std::string& origin) {
  const std::string fingerprint = fingerprintOf(kConverterVersion + ('\n' + origin));
  std::optional<pcrb::PointCounts> kept;
  if (!live_) kept = folder_.kept(cloud_name, fingerprint);
  if (!kept && !force_) folder_.requireReplaceable(cloud_name);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!fingerprints_.emplace(cloud_name, fingerprint).second) {
    throw pcrb::InvalidFile(cloud_name, 0, "a second scan for this cloud", "one");
  }
  ++report_.scans_read;
  if (!kept) return true;
  done_[cloud_name] = {*kept, true};
  progress_.keep(1);
  return false;
}

WorkerPool::Job Conversion::jobFor(const std::string& cloud_name, Make make) {
  Interruption::check();
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::string fingerprint = fingerprints_.at(cloud_name);
  return [this, cloud_name, fingerprint, make = std::move(make)] {
    makeCloud(cloud_name, fingerprint, make);
  };
}

void Conversion::makeCloud(const std::string& cloud_name, const std::string& fingerprint,
                           const Make& make) {
  const ConvertedScan scan = make();
  const bool is_empty = scan.cloud.points.empty();  // no stage after this one could use it
  if (!is_empty) folder_.write(cloud_name, fingerprint, scan.cloud, scan.counts);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (is_empty) {
    report_.dropped["without a valid point"].push_back(cloud_name);
  } else {
    done_[cloud_name] = {scan.counts, false};
  }
  progress_.add(1);
}

void Conversion::add(const std::string& cloud_name, Make make) {
  WorkerPool::Job job = jobFor(cloud_name, std::move(make));
  if (!live_) {
    workers_.submit(std::move(job));
  } else if (!workers_.trySubmit(job)) {
    const std::lock_guard<std::mutex> lock(mutex_);
    report_.dropped["came faster than it could be converted"].push_back(cloud_name);
  }
}

void Conversion::takeBack(const std::string& cloud_name) {
  workers_.finish();
  const std::lock_guard<std::mutex> lock(mutex_);
  fingerprints_.erase(cloud_name);
  done_.erase(cloud_name);
}

void Conversion::drop(const std::string& scan_name, const std::string& reason) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++report_.scans_read;
  report_.dropped[reason].push_back(scan_name);
  progress_.add(1);
}

void Conversion::noteGoingBack() {
  if (!went_back_) note("the stamps went back: what was published again was converted once");
  went_back_ = true;
}

void Conversion::summarize() {
  for (const auto& [name, done] : done_) {
    report_.written.insert(name);
    report_.points += done.counts;
    if (done.kept) ++report_.scans_kept;
  }
}

ConversionReport Conversion::finish() {
  workers_.finish();
  Interruption::check();
  progress_.finish();
  summarize();
  if (report_.written.empty()) {
    throw pcrb::InvalidFile(folder_.path(), "no scan became a cloud\n" + formatReport(report_));
  }
  if (!live_) report_.removed = folder_.removeStale(report_.written);
  report_.others = folder_.othersThan(report_.written);
  if (!report_.others.empty()) {
    note(std::to_string(report_.others.size()) + " other clouds lie in " + folder_.path() +
         ", the first is " + report_.others.front() +
         (live_ ? "; a live run, which may see a part of a log, removes none" : ""));
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
