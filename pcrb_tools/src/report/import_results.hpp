#pragma once

#include <string>
#include <vector>

#include "report/scored_problem.hpp"

namespace pcrb_tools {

/// A result file that this suite has not written.
struct Import {
  std::string method;
  std::string path;
  std::vector<ScoredProblem> problems;
};

/// Reads a comma-separated file (RFC 4180) with a header; columns in any order.
///
/// `ppcr`: `id,initial_misalignment,error`, and the file's name must be
/// `<method>_<sequence>_<kind>.csv`. `csv`: columns of results.csv, of which `error` and
/// `problem_id` (or `id`) must be there, others are read where they are; `sequence`, `kind` and
/// `data_set` come from the file's name where there is no such column. All problems count as
/// replied to where there is no `outcome`. Columns of other names are ignored in `csv` only.
///
/// @throws pcrb::InvalidFile  with file and line, what was found and what was expected.
Import importResults(const std::string& path, const std::string& format);

}  // namespace pcrb_tools
