#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pcrb_tools {

/// What `compute_overlap` is asked for.
struct OverlapOptions {
  std::string folder;                ///< `<root>/<data set>/<sequence>`
  std::string output;                ///< empty = `<folder>_overlap.txt`
  std::optional<double> distance;    ///< m; empty = the data set's
  std::size_t window = 0;            ///< 0 = all ordered pairs
  std::vector<std::string> targets;  ///< empty = all
  std::vector<std::string> excluded;
  int threads = 1;
  bool force = false;  ///< replace an output that somebody else made
};

/// Computes the overlap matrix of a sequence and writes it in the published text format.
///
/// Targets that are done are kept in `<output>.partial`, from which an interrupted run goes on; an
/// output that is complete and unchanged is kept.
/// @throws pcrb::Error  if a cloud, the data set's parameters or the output is not as it should be.
void runOverlapTool(const OverlapOptions& options);

}  // namespace pcrb_tools
