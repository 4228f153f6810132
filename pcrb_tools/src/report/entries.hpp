#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "report/report_tool.hpp"
#include "report/scored_problem.hpp"

namespace pcrb_tools {

/// What a user names a folder or file: `NAME=PATH`, or `PATH`.
struct NamedPath {
  std::string name;  ///< empty if none is given
  std::string path;
};

NamedPath parseNamed(const std::string& text);

/// The last part of a path: what a run is called that has no other name.
std::string lastName(const std::string& path);

/// Reads all runs and imports, one entry per method and kind, in the order in which they are given.
/// A run is called NAME (`NAME=FOLDER`) or after its folder; an import after its file.
///
/// @throws pcrb::Error  if one cannot be read, has no result, or has the name of another one.
std::vector<Entry> loadEntries(const ReportOptions& options);

/// A result file that this suite has not written.
struct Import {
  std::string method;
  std::string sequence;  ///< that the file's name says; empty if its rows say it
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
/// In the file's name, the sequence is the longest known one that stands before `_<kind>`; else
/// what stands behind the method's name, or behind the first `_` without such a beginning.
///
/// Whatever the format: a file of the paper's authors is read as importAuthorsResults() does.
///
/// @param method  empty = from the file's name.
/// @param data_sets  of known sequences; the data set of others is `own`.
/// @throws pcrb::InvalidFile  with file and line, what was found and what was expected.
Import importResults(const std::string& method, const std::string& path, const std::string& format,
                     const std::map<std::string, std::string>& data_sets);

/// Whether a text is a result file of the paper's authors: their command in a comment, then
/// `id;initial_error;final_error;transformation` (in newer ones with a number of iterations before
/// the last one, which the header may not name, or with a `status_code`: what is not `ok` failed).
bool isAuthorsResult(std::string_view text, const std::string& path);

/// Reads such a file, `<sequence>_<kind>_result.txt`.
///
/// @param method  empty = `ppcr` where the command is that of PPCR, else the folder's name.
/// @throws pcrb::InvalidFile  with file and line, what was found and what was expected.
Import importAuthorsResults(const std::string& method, const std::string& path,
                            const std::map<std::string, std::string>& data_sets);

}  // namespace pcrb_tools
