#include "report/import_results.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/csv.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/printable_text.hpp"
#include "pcrb_core/io/text_rows.hpp"
#include "report/catalog.hpp"

namespace pcrb_tools {
namespace {

using Fields = std::vector<std::string>;

/// What `<method>_<sequence>_<kind>.csv` says.
struct FileName {
  std::string method;
  std::string sequence;
  std::string kind;
};

FileName parseFileName(const std::string& path) {
  const std::string stem = std::filesystem::path(path).stem().string();
  const std::size_t first = stem.find('_'), last = stem.rfind('_');
  if (first == std::string::npos || first == last) return {stem, "", ""};
  const std::string kind = stem.substr(last + 1);
  if (kind != "local" && kind != "global") return {stem, "", ""};
  return {stem.substr(0, first), stem.substr(first + 1, last - first - 1), kind};
}

/// Reads the fields of one file's rows.
class Reader {
 public:
  Reader(const pcrb::LineReader& lines, FileName name) : lines_(lines), name_(std::move(name)) {}

  void readHeader(const Fields& header) {
    for (std::size_t i = 0; i < header.size(); ++i) {
      if (!columns_.emplace(header[i], i).second) {
        lines_.fail("column " + pcrb::inQuotes(header[i]) + " again", "it once");
      }
    }
    id_ = has("problem_id") ? "problem_id" : "id";
    for (const std::string& column : {id_, std::string("error")}) {
      if (!has(column)) lines_.fail("no column `" + column + "`", "columns id and error");
    }
    if (!has("sequence") && name_.sequence.empty()) {
      lines_.fail("no column `sequence`", "it, or a file called <method>_<sequence>_<kind>.csv");
    }
  }

  void requireExactly(const std::vector<std::string>& names) const {
    for (const std::string& name : names) {
      if (!has(name)) lines_.fail("no column `" + name + "`", "id,initial_misalignment,error");
    }
    if (columns_.size() != names.size()) {
      lines_.fail(std::to_string(columns_.size()) + " columns", "id,initial_misalignment,error");
    }
  }

  ScoredProblem readRow(const Fields& row) {
    if (row.size() != columns_.size()) {
      lines_.fail(std::to_string(row.size()) + " fields", std::to_string(columns_.size()));
    }
    row_ = &row;
    ScoredProblem problem;
    problem.key = key();
    problem.error = *number("error", true);
    problem.initial_misalignment = number("initial_misalignment");
    problem.overlap = number("overlap");
    problem.rotation_error = number("rotation_error_rad");
    problem.translation_error = number("translation_error_m");
    problem.runtime = number("runtime_s");
    problem.solver_time = number("solver_time_s");
    problem.source = text("source");
    problem.target = text("target");
    problem.reason = text("reason");
    problem.target_changed = text("target_changed") == "1";
    if (has("outcome")) named([&] { problem.outcome = pcrb::outcomeFromString(text("outcome")); });
    return problem;
  }

 private:
  bool has(const std::string& column) const { return columns_.count(column) > 0; }

  std::string text(const std::string& column) const {
    const auto found = columns_.find(column);
    return found == columns_.end() ? std::string() : pcrb::printableText(row_->at(found->second));
  }

  std::optional<double> number(const std::string& column, bool is_needed = false) const {
    const std::string field = text(column);
    if (field.empty() && !is_needed) return std::nullopt;
    const auto value = pcrb::parseDouble(field);
    if (!value || !std::isfinite(*value) || *value < 0.0) {
      lines_.fail(pcrb::inQuotes(field), "a number >= 0 in column `" + column + "`");
    }
    return value;
  }

  pcrb::ProblemKey key() const {
    pcrb::ProblemKey key;
    key.problem_id = text(id_);
    if (key.problem_id.empty()) lines_.fail("an empty field", "an id in column `" + id_ + "`");
    key.sequence = has("sequence") ? text("sequence") : name_.sequence;
    key.data_set = has("data_set") ? text("data_set") : publishedDataSet(key.sequence);
    const std::string kind = has("kind") ? text("kind") : name_.kind;
    named([&] { key.kind = kind.empty() ? pcrb::Kind::kLocal : pcrb::kindFromString(kind); });
    return key;
  }

  void named(const std::function<void()>& action) const {
    try {
      action();
    } catch (const pcrb::InvalidParameter& error) {
      throw pcrb::InvalidFile(lines_.name() + ":" + std::to_string(lines_.lineNumber()),
                              error.what());
    }
  }

  const pcrb::LineReader& lines_;
  FileName name_;
  std::map<std::string, std::size_t> columns_;
  std::string id_;
  const Fields* row_ = nullptr;
};

}  // namespace

Import importResults(const std::string& path, const std::string& format) {
  const FileName name = parseFileName(path);
  const pcrb::FileBytes file(path);
  pcrb::LineReader lines(file.text(), path);
  Reader reader(lines, name);
  Fields fields;
  if (!pcrb::nextCsvRow(lines, fields)) {
    throw pcrb::InvalidFile(path, 1, "nothing", "a header");
  }
  reader.readHeader(fields);
  if (format == "ppcr") reader.requireExactly({"id", "initial_misalignment", "error"});
  Import import{name.method, path, {}};
  while (pcrb::nextCsvRow(lines, fields)) import.problems.push_back(reader.readRow(fields));
  if (import.problems.empty()) throw pcrb::InvalidFile(path, 0, "no row", "one per problem");
  return import;
}

}  // namespace pcrb_tools
