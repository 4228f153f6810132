#pragma once

#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

namespace pcrb_tools {

/// What `check_dataset` is asked for.
struct CheckOptions {
  std::string root;                    ///< folder of data sets in the common layout
  std::vector<std::string> sequences;  ///< `<data set>` or `<data set>/<sequence>`; empty = all
  std::size_t overlap_pairs = 5;       ///< pairs of each problem file whose overlap is recomputed
  bool strict = false;                 ///< warnings count as errors
  int threads = 1;
};

/// Checks data sets in the common layout and prints one line per finding, `error: file: what`, and
/// a last line with the counts.
///
/// @return  whether no error was found (with `strict`, nor a warning).
/// @throws pcrb::Error  if the root is no folder, holds no problem file, or a wanted sequence is
///                      not there.
bool runCheckTool(const CheckOptions& options, std::ostream& out);

}  // namespace pcrb_tools
