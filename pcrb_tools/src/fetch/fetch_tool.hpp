#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "common/sequence_paths.hpp"
#include "fetch/download.hpp"
#include "fetch/sources.hpp"

namespace pcrb_tools {

/// What `fetch_datasets` is asked for.
struct FetchOptions {
  std::string sources;                 ///< the list of sources, a YAML file
  std::string logs;                    ///< folder that downloads go to
  std::string root;                    ///< of the common layout
  std::string from;                    ///< folder of files that the user has; empty = none
  std::vector<std::string> sequences;  ///< words of pcrb::namesSequence; empty = all
  SourceSet set = SourceSet::kPublished;
  bool dry_run = false;  ///< only say what would be done
  bool force = false;    ///< replace files of the layout that are something else
  bool prepare = true;   ///< convert and check what was fetched
  int threads = 1;       ///< of the check
  /// Converts a log into the common layout; returns whether it succeeded.
  std::function<bool(const SequenceLog& log)> convert;
  /// Checks sequences of the common layout; returns whether it found no error.
  std::function<bool(const std::vector<std::string>& sequences, std::ostream& out)> check;
  DownloadPolicy policy;
};

/// Runs the converter of a log's data set, which lies beside this program, as a process of its own.
///
/// @return  whether it succeeded; it has said itself what was wrong.
/// @throws pcrb::InvalidFile  if it cannot be started.
bool runConverter(const SequenceLog& log, const FetchOptions& options);

/// Fetches the files of the wanted sequences, verifies them, puts clouds and problem files into the
/// common layout, converts the logs and checks the result.
///
/// What is complete and unchanged is kept: a rerun downloads what is missing, from where it
/// stopped. A file that cannot be fetched does not keep others from being fetched.
/// @return  whether everything was fetched and, with `prepare`, the check found no error.
/// @throws pcrb::Error  if the sources are malformed or a wanted sequence is not in them.
bool runFetchTool(const FetchOptions& options, std::ostream& out);

}  // namespace pcrb_tools
