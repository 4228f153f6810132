#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/csv.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"
#include "report/entries.hpp"

namespace pcrb_tools {
namespace {

using Fields = std::vector<std::string>;
using DataSets = std::map<std::string, std::string>;

/// What `<method>_<sequence>_<kind>.csv` says.
struct FileName {
  std::string method;
  std::string sequence;
  std::string kind;
};

/// Where the sequence begins in `<method>_<sequence>`, or, if the method is given, `<sequence>`;
/// the text's size if nowhere.
std::size_t sequencePlace(const std::string& text, const std::string& method,
                          const DataSets& data_sets) {
  if (!method.empty() && data_sets.count(text) > 0) return 0;
  std::size_t place = text.size();
  for (const auto& [sequence, data_set] : data_sets) {
    const std::string ending = "_" + sequence;
    if (text.size() <= ending.size()) continue;
    const std::size_t start = text.size() - ending.size();
    if (text.compare(start, ending.size(), ending) == 0) place = std::min(place, start + 1);
  }
  if (place < text.size()) return place;
  if (!method.empty() && pcrb::startsWith(text, method + "_")) return method.size() + 1;
  const std::size_t first = text.find('_');
  return first == 0 || first == std::string::npos ? text.size() : first + 1;
}

FileName parseFileName(const std::string& path, const std::string& method,
                       const DataSets& data_sets) {
  const std::string stem = std::filesystem::path(path).stem().string();
  const FileName unknown{method.empty() ? stem : method, "", ""};
  const std::size_t last = stem.rfind('_');
  if (last == std::string::npos) return unknown;
  const std::string kind = stem.substr(last + 1), text = stem.substr(0, last);
  if (kind != "local" && kind != "global") return unknown;
  const std::size_t place = sequencePlace(text, method, data_sets);
  if (place == text.size()) return unknown;
  return {method.empty() ? text.substr(0, place - 1) : method, text.substr(place), kind};
}

/// Reads the fields of one file's rows.
class Reader {
 public:
  Reader(const pcrb::LineReader& lines, FileName name, const DataSets& data_sets)
      : lines_(lines), name_(std::move(name)), data_sets_(data_sets) {}

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

  /// The sequence of all rows, if there is no column for it.
  std::string sequence() const { return has("sequence") ? std::string() : name_.sequence; }

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
    key.data_set = has("data_set") ? text("data_set") : dataSetOf(key.sequence);
    const std::string kind = has("kind") ? text("kind") : name_.kind;
    named([&] { key.kind = kind.empty() ? pcrb::Kind::kLocal : pcrb::kindFromString(kind); });
    return key;
  }

  std::string dataSetOf(const std::string& sequence) const {
    const auto known = data_sets_.find(sequence);
    return known == data_sets_.end() ? "own" : known->second;
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
  const DataSets& data_sets_;
  std::map<std::string, std::size_t> columns_;
  std::string id_;
  const Fields* row_ = nullptr;
};

}  // namespace

Import importResults(const std::string& method, const std::string& path, const std::string& format,
                     const DataSets& data_sets) {
  const pcrb::FileBytes file(path);
  if (isAuthorsResult(file.text(), path)) return importAuthorsResults(method, path, data_sets);
  const FileName name = parseFileName(path, method, data_sets);
  pcrb::LineReader lines(file.text(), path);
  Reader reader(lines, name, data_sets);
  Fields fields;
  if (!pcrb::nextCsvRow(lines, fields)) {
    throw pcrb::InvalidFile(path, 1, "nothing", "a header");
  }
  reader.readHeader(fields);
  if (format == "ppcr") reader.requireExactly({"id", "initial_misalignment", "error"});
  Import import{name.method, reader.sequence(), path, {}};
  while (pcrb::nextCsvRow(lines, fields)) import.problems.push_back(reader.readRow(fields));
  if (import.problems.empty()) throw pcrb::InvalidFile(path, 0, "no row", "one per problem");
  return import;
}

}  // namespace pcrb_tools
