#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "pcrb_core/datasets/sensor_scan.hpp"
#include "pcrb_core/point_cloud.hpp"
#include "pcrb_tools/conversion/cloud_folder.hpp"
#include "pcrb_tools/conversion/worker_pool.hpp"
#include "pcrb_tools/progress.hpp"

namespace pcrb_tools {

/// What all converters are asked for.
struct ConversionRequest {
  std::vector<std::string> inputs;  ///< folders, archives, bags, single files
  std::string root;                 ///< of the common layout
  std::string data_set;
  std::string sequence;  ///< empty: from the names of the inputs
  int threads = 1;

  /// Scans that may wait for a thread, with their data; 0 = as many as threads.
  std::size_t max_waiting = 0;
  /// What happens to one more: a live stream cannot wait.
  bool drop_when_full = false;
};

/// A cloud and what was left out of it.
struct ConvertedScan {
  pcrb::DatasetCloud cloud;
  pcrb::PointCounts counts;
};

/// What a conversion did.
struct ConversionReport {
  std::string sequence;
  std::size_t scans_read = 0;     ///< in the log, dropped ones included
  std::size_t scans_kept = 0;     ///< of the written ones: complete from an earlier run
  std::set<std::string> written;  ///< names of the clouds, kept ones included
  std::map<std::string, std::vector<std::string>> dropped;  ///< names of scans, by reason
  pcrb::PointCounts points;                                 ///< of the written clouds
  std::vector<std::string> notes;                           ///< what a user should know

  std::size_t scansDropped() const;
};

/// The report in a few lines of text.
std::string formatReport(const ConversionReport& report);

/// One run of a converter: clouds are made in parallel and end up in their folder; what an earlier
/// run completed from the same inputs is kept.
class Conversion {
 public:
  using Make = std::function<ConvertedScan()>;

  /// @param total_scans  for the progress display; 0 = unknown
  Conversion(const ConversionRequest& request, const std::string& sequence,
             std::size_t total_scans);

  /// Whether a cloud has to be made; if not, it counts as done.
  ///
  /// @param origin  describes everything that the cloud depends on: input, pose, options.
  /// @throws InvalidFile  if the name was announced before.
  bool wants(const std::string& cloud_name, const std::string& origin);

  /// Makes and writes a cloud that wants() wanted, on another thread; while too many wait, waits or
  /// drops it.
  ///
  /// @throws what an earlier scan has thrown, or Interrupted.
  void add(const std::string& cloud_name, Make make);

  /// Counts a scan that becomes no cloud.
  void drop(const std::string& scan_name, const std::string& reason);

  /// Throws what a scan has thrown, for callers between whose scans time may pass.
  void check() { workers_.check(); }

  void note(const std::string& text) { report_.notes.push_back(text); }

  /// Waits for all clouds.
  ///
  /// @throws what a scan has thrown, or Interrupted; InvalidFile if there is no cloud at all.
  ConversionReport finish();

  const std::string& folder() const { return folder_.path(); }

 private:
  WorkerPool::Job jobFor(const std::string& cloud_name, Make make);

  CloudFolder folder_;
  std::mutex mutex_;
  ConversionReport report_;
  std::map<std::string, std::string> fingerprints_;
  Progress progress_;
  const bool drop_when_full_;
  WorkerPool workers_;  // last: its threads end before what they use
};

/// Lines for clouds that problem files beside the sequence's folder name and that are not in it;
/// empty without problem files.
std::vector<std::string> describeMissingClouds(const ConversionRequest& request,
                                               const ConversionReport& report);

/// Prints the report and the clouds that are missing: what every converter ends with.
void printReport(const ConversionRequest& request, const ConversionReport& report);

}  // namespace pcrb_tools
