#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "common/progress.hpp"
#include "conversion/cloud_folder.hpp"
#include "conversion/worker_pool.hpp"
#include "pcrb_core/datasets/sensor_scan.hpp"
#include "pcrb_core/point_cloud.hpp"

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
  /// A stream that is published meanwhile: it cannot wait, so that one more is dropped; and it may
  /// be another one than before, or a part, so that what an earlier run made is neither taken for
  /// done nor removed.
  bool live = false;
  bool force = false;  ///< replace clouds that no converter made, or that were changed since
};

/// A cloud and what was left out of it.
struct ConvertedScan {
  pcrb::DatasetCloud cloud;
  pcrb::PointCounts counts;
};

/// What a conversion did.
struct ConversionReport {
  std::string sequence;
  std::size_t scans_read = 0;        ///< in the log, dropped ones included
  std::size_t scans_kept = 0;        ///< of the written ones: complete from an earlier run
  std::set<std::string> written;     ///< names of the clouds, kept ones included
  std::vector<std::string> removed;  ///< clouds of earlier runs that this one does not make
  std::vector<std::string> others;   ///< clouds in the folder that are not of this run
  std::map<std::string, std::vector<std::string>> dropped;  ///< names of scans, by reason
  pcrb::PointCounts points;                                 ///< of the written clouds
  std::vector<std::string> notes;                           ///< what a user should know

  std::size_t scansDropped() const;
};

/// The report in a few lines of text.
std::string formatReport(const ConversionReport& report);

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

  /// Forgets a cloud that was announced before, as better scans for it have come; waits for those
  /// under way.
  void takeBack(const std::string& cloud_name);

  /// Counts a scan that becomes no cloud.
  void drop(const std::string& scan_name, const std::string& reason);

  /// Throws what a scan has thrown, for callers between whose scans time may pass.
  void check() { workers_.check(); }

  void note(const std::string& text) { report_.notes.push_back(text); }

  /// Notes, once, that a stream went back in time.
  void noteGoingBack();

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
  void summarize();

  CloudFolder folder_;
  std::mutex mutex_;
  ConversionReport report_;
  std::map<std::string, std::string> fingerprints_;  ///< of the announced clouds
  std::map<std::string, Done> done_;
  bool went_back_ = false;
  Progress progress_;
  const bool live_;
  const bool force_;
  WorkerPool workers_;  // last: its threads end before what they use
};

/// Lines for clouds that problem files beside the sequence's folder name and that are not in it;
/// empty without problem files.
std::vector<std::string> describeMissingClouds(const ConversionRequest& request,
                                               const ConversionReport& report);

/// Prints the report and the clouds that are missing: what every converter ends with.
void printReport(const ConversionRequest& request, const ConversionReport& report);

}  // namespace pcrb_tools
