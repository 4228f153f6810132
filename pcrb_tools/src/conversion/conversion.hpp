#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/progress.hpp"
#include "conversion/cloud_folder.hpp"
#include "conversion/conversion_report.hpp"
#include "conversion/log_files.hpp"
#include "conversion/worker_pool.hpp"
#include "pcrb_core/datasets/sensor_scan.hpp"
#include "pcrb_core/datasets/trajectory.hpp"
#include "pcrb_core/io/memory_budget.hpp"
#include "pcrb_core/point_cloud.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb_tools {

/// A cloud and what was left out of it.
struct ConvertedScan {
  pcrb::MemoryBudget::Share memory{};  ///< that the cloud has; given back after the cloud
  pcrb::DatasetCloud cloud{};
  pcrb::PointCounts counts{};
  std::string refusal{};  ///< why there is no cloud; empty = there is
};

/// A scan where it belongs.
ConvertedScan placed(pcrb::SensorScan scan, const pcrb::Transform& T_world_sensor);

/// Waits for the memory that a scan takes, before its files are read.
/// @throws InvalidFile  if that is more than the process's MemoryBudget.
pcrb::MemoryBudget::Share takeMemoryOfFiles(const std::vector<std::string>& files);

/// One run of a converter: clouds are made in parallel and end up in their folder; what an earlier
/// run completed from the same inputs is kept, what it made and this one does not is removed.
class Conversion {
 public:
  using Make = std::function<ConvertedScan()>;

  /// @param total_scans  for the progress display; 0 = unknown
  Conversion(const ConversionRequest& request, const std::string& sequence,
             std::size_t total_scans);

  /// Whether a cloud has to be made; if not, it counts as done.
  ///
  /// @param origin  describes everything that the cloud depends on: input, pose, options.
  /// @throws InvalidFile  if the name was announced before, or is that of a file which is not the
  ///                      converter's to replace.
  bool wants(const std::string& cloud_name, const std::string& origin);

  /// Makes and writes a cloud that wants() wanted, on another thread; while too many wait, waits or
  /// drops it.
  ///
  /// @throws what an earlier scan has thrown, or Interrupted.
  void add(const std::string& cloud_name, Make make);

  /// Waits for the clouds that were added so far.
  /// @throws what one of them has thrown.
  void waitForAll();

  /// Forgets a cloud that was announced before, as better scans for it have come; waits for those
  /// under way.
  void retract(const std::string& cloud_name);

  /// Counts a scan that becomes no cloud.
  void drop(const std::string& scan_name, const std::string& reason);

  /// Counts a scan without a pose. If no scan has one, the error says why, by these stamps.
  void dropUnposed(const std::string& scan_name, pcrb::Stamp stamp, const std::string& reason);

  /// @param stamps  of the poses, ascending
  void setPoseStamps(std::vector<pcrb::Stamp> stamps) { pose_stamps_ = std::move(stamps); }

  /// Throws what a scan has thrown, for callers between whose scans time may pass.
  void check() {
    workers_.check();
    commits_.check();
  }

  void note(const std::string& text) { report_.notes.push_back(text); }

  /// Notes, unless there is none, how many poses were left out, as a later one has their stamp.
  void noteDuplicatePoses(std::size_t count);

  /// Notes, once, that the stamps of a stream jumped back.
  void noteTimeJump();

  /// Waits for all clouds, then removes those of earlier runs that are not among them.
  ///
  /// @throws what a scan has thrown, or Interrupted; InvalidFile if there is no cloud at all.
  ConversionReport finish();

  const std::string& folder() const { return folder_.path(); }

 private:
  struct Done {
    pcrb::PointCounts counts;
    bool kept = false;
  };

  WorkerPool::Job jobFor(const std::string& cloud_name, Make make);
  void makeCloud(const std::string& cloud_name, const std::string& fingerprint, const Make& make);
  void commitLater(const std::string& cloud_name, const pcrb::PointCounts& counts,
                   std::function<void()> commit);
  void summarize();
  void requireClouds() const;

  CloudFolder folder_;
  std::mutex mutex_;
  ConversionReport report_;
  std::map<std::string, std::string> fingerprints_;  ///< of the announced clouds
  std::map<std::string, Done> done_;
  std::vector<pcrb::Stamp> unposed_;               ///< of scans without a pose
  std::vector<pcrb::Stamp> pose_stamps_;           ///< ascending
  std::map<std::string, std::size_t> odd_clouds_;  ///< how many have a reader's note
  bool went_back_ = false;
  Progress progress_;
  const bool live_;
  const bool force_;
  WorkerPool commits_;  ///< wait for the disk, while the workers work on
  WorkerPool workers_;  // last: its threads end before what they use
};

/// Tells a conversion of the poses of a ground truth: their stamps, how many were not used, as a
/// later one has their stamp, and what was concluded from their file.
void announcePoses(const pcrb::Trajectory& trajectory, Conversion& conversion,
                   const std::vector<std::string>& notes = {});

/// A pose for fingerprints: equal texts mean equal bits.
std::string poseText(const pcrb::Transform& pose);

/// A cloud that is made from one file of a log.
struct FileScan {
  std::size_t file = 0;  ///< index among the log's files
  std::string cloud_name;
  std::string origin;  ///< what the cloud depends on beside the file: pose, options
  /// Makes the cloud from the file's bytes; `path` is for messages.
  std::function<ConvertedScan(std::string_view bytes, const std::string& path)> make;
};

/// Converts scans that are one file each, in parallel: files of folders are read by the workers,
/// archives once from start to end.
void convertFileScans(const LogFiles& files, std::vector<FileScan> scans, Conversion& conversion);

}  // namespace pcrb_tools
