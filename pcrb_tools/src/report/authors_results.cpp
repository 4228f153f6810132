#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>

#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"
#include "report/entries.hpp"

namespace pcrb_tools {
namespace {

constexpr const char* kAuthorsColumns =
    "id;initial_error;final_error;transformation, perhaps with further ones";
constexpr std::size_t kMatrixNumbers = 16;

bool isComment(std::string_view line) { return pcrb::startsWith(pcrb::trimmed(line), "#"); }

double authorsError(const pcrb::LineReader& lines, std::string_view field) {
  const auto value = pcrb::parseDouble(field);
  if (!value || !std::isfinite(*value) || *value < 0.0) {
    lines.fail(pcrb::inQuotes(field), "an error: a finite number >= 0");
  }
  return *value;
}

/// A row that was cut off must not pass for a whole one.
void requireMatrix(const pcrb::LineReader& lines, std::string_view field) {
  std::vector<std::string_view> numbers;
  pcrb::splitAtBlanks(field, numbers);
  if (numbers.size() != kMatrixNumbers) {
    lines.fail("a transformation of " + std::to_string(numbers.size()) + " numbers",
               std::to_string(kMatrixNumbers) + ", row by row");
  }
}

bool isAuthorsHeader(std::string_view line) {
  return line.find(';') != std::string_view::npos &&
         line.find("final_error") != std::string_view::npos;
}

/// Columns by name, since the authors' programs write different ones.
class AuthorsRows {
 public:
  AuthorsRows(const pcrb::LineReader& lines, std::string_view header) : lines_(lines) {
    pcrb::splitAt(';', header, fields_);
    columns_.assign(fields_.begin(), fields_.end());
    for (const char* name : {"id", "initial_error", "final_error", "transformation"}) {
      if (count(name) != 1) {
        lines_.fail(std::to_string(count(name)) + " columns `" + name + "`",
                    std::string("a header ") + kAuthorsColumns);
      }
    }
  }

  ScoredProblem read(std::string_view line) {
    pcrb::splitAt(';', line, fields_);
    if (fields_.size() != columns_.size() && !hasUnnamedIterations()) {
      lines_.fail(std::to_string(fields_.size()) + " fields", kAuthorsColumns);
    }
    ScoredProblem problem;
    problem.key.problem_id = pcrb::printableText(field("id"));
    if (problem.key.problem_id.empty()) lines_.fail("an empty field", "an id");
    problem.initial_misalignment = authorsError(lines_, field("initial_error"));
    problem.error = authorsError(lines_, field("final_error"));
    requireMatrix(lines_, hasUnnamedIterations() ? fields_.back() : field("transformation"));
    if (count("status_code") > 0 && field("status_code") != "ok") {
      problem.outcome = pcrb::Outcome::kFailed;
      problem.reason = pcrb::printableText(field("status_code"));
    }
    return problem;
  }

 private:
  std::ptrdiff_t count(const std::string& name) const {
    return std::count(columns_.begin(), columns_.end(), name);
  }

  std::string_view field(const std::string& name) const {
    const auto place = std::find(columns_.begin(), columns_.end(), name) - columns_.begin();
    return fields_.at(static_cast<std::size_t>(place));
  }

  /// The header of PPCR's files has no name for the number of iterations before the last field.
  bool hasUnnamedIterations() const {
    return fields_.size() == columns_.size() + 1 && columns_.back() == "transformation";
  }

  const pcrb::LineReader& lines_;
  std::vector<std::string> columns_;
  std::vector<std::string_view> fields_;
};

/// Sequence and kind of `<sequence>_<kind>_result.txt`.
pcrb::ProblemKey keyOfFile(const std::string& path,
                           const std::map<std::string, std::string>& data_sets) {
  const std::string stem = std::filesystem::path(path).stem().string();
  for (const pcrb::Kind kind : {pcrb::Kind::kLocal, pcrb::Kind::kGlobal}) {
    const std::string ending = std::string("_") + pcrb::toString(kind) + "_result";
    if (stem.size() <= ending.size()) continue;
    const std::size_t size = stem.size() - ending.size();
    if (stem.substr(size) != ending) continue;
    pcrb::ProblemKey key;
    key.sequence = stem.substr(0, size);
    key.kind = kind;
    const auto known = data_sets.find(key.sequence);
    key.data_set = known == data_sets.end() ? "own" : known->second;
    return key;
  }
  throw pcrb::InvalidFile(path, 0, "this name",
                          "<sequence>_local_result.txt or <sequence>_global_result.txt");
}

/// The authors' programs write their command first; that of PPCR is known.
std::string authorsMethod(const std::string& path, std::string_view command) {
  while (pcrb::startsWith(command, "#") || pcrb::startsWith(command, ";")) command.remove_prefix(1);
  if (pcrb::startsWith(pcrb::trimmed(command), "prob_registration")) return "ppcr";
  const auto folder = std::filesystem::absolute(path).lexically_normal().parent_path();
  return folder.filename().string();
}

}  // namespace

bool isAuthorsResult(std::string_view text, const std::string& path) {
  pcrb::LineReader lines(text, path);
  std::string_view line;
  if (!lines.nextRow(line)) return false;
  const bool has_command = pcrb::startsWith(line, "#;");
  while (isComment(line) && lines.nextRow(line)) continue;
  return has_command || isAuthorsHeader(line);
}

Import importAuthorsResults(const std::string& method, const std::string& path,
                            const std::map<std::string, std::string>& data_sets) {
  const pcrb::FileBytes file(path);
  pcrb::LineReader lines(file.text(), path);
  const pcrb::ProblemKey key = keyOfFile(path, data_sets);
  std::string_view line;
  std::string_view command;
  bool has_line = lines.nextRow(line);
  if (has_line && isComment(line)) command = pcrb::trimmed(line);
  while (has_line && isComment(line)) has_line = lines.nextRow(line);
  if (!has_line || !isAuthorsHeader(line)) {
    lines.fail(has_line ? pcrb::inQuotes(line) : "nothing",
               std::string("a header ") + kAuthorsColumns);
  }
  AuthorsRows rows(lines, line);
  Import import{method.empty() ? authorsMethod(path, command) : method, key.sequence, path, {}};
  while (lines.nextRow(line)) {
    import.problems.push_back(rows.read(line));
    pcrb::ProblemKey& own = import.problems.back().key;
    own.data_set = key.data_set;
    own.sequence = key.sequence;
    own.kind = key.kind;
  }
  if (import.problems.empty()) throw pcrb::InvalidFile(path, 0, "no row", "one per problem");
  return import;
}

}  // namespace pcrb_tools
