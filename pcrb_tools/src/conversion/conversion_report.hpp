#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "pcrb_core/datasets/sensor_scan.hpp"

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

/// Lines for clouds that problem files beside the sequence's folder name and that are not in it;
/// empty without problem files.
std::vector<std::string> describeMissingClouds(const ConversionRequest& request,
                                               const ConversionReport& report);

/// Prints the report and the clouds that are missing: what every converter ends with.
void printReport(const ConversionRequest& request, const ConversionReport& report);

}  // namespace pcrb_tools
