#include "conversion/conversion.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

#include "common/process.hpp"
#include "pcrb_core/datasets/stamp_mismatch.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/problem/problem.hpp"

namespace pcrb_tools {
namespace {

/// Part of every fingerprint: raise it when the same log gives other bytes.
constexpr const char* kConverterVersion = "2";

/// Clouds that are written and for which the disk is waited: it takes several at once as soon as
/// one.
constexpr int kCommitThreads = 4;

/// Waits for the memory that a scan's bytes, points and written cloud take together.
/// @param unpacked  bytes that are packed in it
pcrb::MemoryBudget::Share takeMemoryOfScan(const std::string& path, std::size_t bytes,
                                           std::size_t unpacked) {
  constexpr std::size_t kExpansion = 6;  // of a binary scan, which expands most if none is packed
  pcrb::MemoryBudget& budget = pcrb::MemoryBudget::ofProcess();
  const std::size_t needed = std::max(kExpansion * bytes, bytes + unpacked);
  if (needed <= budget.limit()) return budget.take(needed);
  const auto [found, expected] = pcrb::describeExcess("a scan", needed, budget.limit());
  throw pcrb::InvalidFile(path, 0, found, expected);
}

}  // namespace

ConvertedScan placed(pcrb::SensorScan scan, const pcrb::Transform& T_world_sensor) {
  const pcrb::PointCounts counts = scan.counts;
  return {{}, pcrb::placeScan(std::move(scan), T_world_sensor), counts};
}

pcrb::MemoryBudget::Share takeMemoryOfFiles(const std::vector<std::string>& files) {
  std::size_t bytes = 0;
  std::size_t unpacked = 0;
  for (const std::string& file : files) {
    std::error_code is_none;  // a regular file: who reads it will say so
    const std::uintmax_t size = std::filesystem::file_size(file, is_none);
    if (is_none) continue;
    bytes += size;
    unpacked += pcrb::memoryOfPackedPcdFile(file);
  }
  return takeMemoryOfScan(files.front(), bytes, unpacked);
}

void announcePoses(const pcrb::Trajectory& trajectory, Conversion& conversion,
                   const std::vector<std::string>& notes) {
  conversion.setPoseStamps(trajectory.stamps());
  conversion.noteDuplicatePoses(trajectory.duplicates());
  for (const std::string& note : notes) conversion.note(note);
}

std::string poseText(const pcrb::Transform& pose) {
  std::string text;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      text += ' ';
      pcrb::appendShortest(text, pose.matrix()(row, column));
    }
  }
  return text;
}

void convertFileScans(const LogFiles& files, std::vector<FileScan> scans, Conversion& conversion) {
  std::map<std::size_t, FileScan> in_archives;
  std::vector<std::size_t> indices;
  for (auto& scan : scans) {
    const LogFile& file = files.all().at(scan.file);
    if (!conversion.wants(scan.cloud_name, file.identity + '\n' + file.name + '\n' + scan.origin)) {
      continue;
    }
    if (file.in_archive) {
      indices.push_back(scan.file);
      in_archives.emplace(scan.file, std::move(scan));
      continue;
    }
    conversion.add(scan.cloud_name, [&files, index = scan.file, make = std::move(scan.make)] {
      const std::string path = files.all()[index].path();
      auto memory = takeMemoryOfFiles({path});
      const pcrb::FileBytes bytes = files.read(index);
      ConvertedScan converted = make(bytes.text(), path);
      converted.memory = std::move(memory);
      return converted;
    });
  }
  // Those have their memory while they wait, and a job before them would wait for it for ever.
  conversion.waitForAll();
  files.readArchived(indices, [&](std::size_t index, std::string bytes) {
    FileScan& scan = in_archives.at(index);
    const std::string path = files.all()[index].path();
    const auto share = std::make_shared<pcrb::MemoryBudget::Share>(
        takeMemoryOfScan(path, bytes.size(), pcrb::memoryOfPackedPcd(bytes)));
    const auto shared = std::make_shared<const std::string>(std::move(bytes));
    conversion.add(scan.cloud_name, [share, shared, path, make = std::move(scan.make)] {
      return make(*shared, path);
    });
  });
}

Conversion::Conversion(const ConversionRequest& request, const std::string& sequence,
                       std::size_t total_scans)
    : folder_(request.root, request.data_set, sequence),
      progress_(sequence, "scans", total_scans),
      live_(request.live),
      force_(request.force),
      commits_(kCommitThreads, kCommitThreads),
      workers_(request.threads, request.max_waiting > 0
                                    ? request.max_waiting
                                    : static_cast<std::size_t>(request.threads)) {
  report_.sequence = sequence;
}

bool Conversion::wants(const std::string& cloud_name, const std::string& origin) {
  const std::string fingerprint = pcrb::fingerprintOf(kConverterVersion + ('\n' + origin));
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
  for (const std::string& odd : scan.cloud.notes) {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++odd_clouds_[odd];
  }
  std::string refusal = scan.refusal;
  // No stage after this one could use an empty cloud.
  if (refusal.empty() && scan.cloud.points.empty()) refusal = "without a valid point";
  if (refusal.empty()) {
    commitLater(cloud_name, scan.counts,
                folder_.write(cloud_name, fingerprint, scan.cloud, scan.counts));
    return;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  report_.dropped[refusal].push_back(cloud_name);
  progress_.add(1);
}

void Conversion::commitLater(const std::string& cloud_name, const pcrb::PointCounts& counts,
                             std::function<void()> commit) {
  commits_.submit([this, cloud_name, counts, commit = std::move(commit)] {
    commit();
    const std::lock_guard<std::mutex> lock(mutex_);
    done_[cloud_name] = {counts, false};
    progress_.add(1);
  });
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

void Conversion::waitForAll() {
  workers_.finish();
  commits_.finish();
}

void Conversion::retract(const std::string& cloud_name) {
  waitForAll();
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

void Conversion::dropUnposed(const std::string& scan_name, pcrb::Stamp stamp,
                             const std::string& reason) {
  drop(scan_name, reason);
  unposed_.push_back(stamp);
}

void Conversion::requireClouds() const {
  if (!report_.written.empty()) return;
  std::string why;
  if (!unposed_.empty() && !pose_stamps_.empty()) {
    why = "; no pose: " + pcrb::describeMismatch(unposed_, pose_stamps_);
  }
  throw pcrb::InvalidFile(folder_.path(),
                          "no scan became a cloud" + why + "\n" + formatReport(report_));
}

void Conversion::noteTimeJump() {
  if (!went_back_) note("the stamps went back: what was published again was converted once");
  went_back_ = true;
}

void Conversion::noteDuplicatePoses(std::size_t count) {
  if (count == 0) return;
  note(std::to_string(count) +
       " poses have the stamp of a later one, or its scan, and were not used");
}

void Conversion::summarize() {
  for (const auto& [name, done] : done_) {
    report_.written.insert(name);
    report_.points += done.counts;
    if (done.kept) ++report_.scans_kept;
  }
  for (const auto& [odd, clouds] : odd_clouds_) {
    note(odd + " (" + std::to_string(clouds) + " clouds)");
  }
}

ConversionReport Conversion::finish() {
  waitForAll();
  Interruption::check();
  progress_.finish();
  summarize();
  requireClouds();
  if (!live_) report_.removed = folder_.removeStale(report_.written);
  report_.others = folder_.othersThan(report_.written);
  if (!report_.others.empty()) {
    note(std::to_string(report_.others.size()) + " other clouds lie in " + folder_.path() +
         ", the first is " + report_.others.front() +
         (live_ ? "; a live run, which may see a part of a log, removes none" : ""));
  }
  return report_;
}

}  // namespace pcrb_tools
