#include <cmath>
#include <filesystem>
#include <string_view>

#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"
#include "report/entries.hpp"

namespace pcrb_tools {
namespace {

constexpr std::string_view kAuthorsHeader = "id;initial_error;final_error";
constexpr const char* kAuthorsColumns =
    "id;initial_error;final_error;transformation, with or without iterations before the last one";
constexpr std::size_t kMatrixNumbers = 16;

bool startsWith(std::string_view text, std::string_view beginning) {
  return text.substr(0, beginning.size()) == beginning;
}

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

ScoredProblem readAuthorsRow(const pcrb::LineReader& lines, std::string_view line) {
  std::vector<std::string_view> fields;
  pcrb::splitAt(';', line, fields);
  if (fields.size() != 4 && fields.size() != 5) {
    lines.fail(std::to_string(fields.size()) + " fields", kAuthorsColumns);
  }
  ScoredProblem problem;
  problem.key.problem_id = pcrb::printableText(fields[0]);
  if (problem.key.problem_id.empty()) lines.fail("an empty field", "an id");
  problem.initial_misalignment = authorsError(lines, fields[1]);
  problem.error = authorsError(lines, fields[2]);
  requireMatrix(lines, fields.back());
  return problem;
}

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
  if (startsWith(command, "#;prob_registration")) return "ppcr";
  const auto folder = std::filesystem::absolute(path).lexically_normal().parent_path();
  return folder.filename().string();
}

}  // namespace

bool isAuthorsResult(std::string_view text) {
  return startsWith(text, "#;") || startsWith(text, kAuthorsHeader) ||
         (startsWith(text, "#") && text.find(kAuthorsHeader) != std::string_view::npos);
}

Import importAuthorsResults(const std::string& method, const std::string& path,
                            const std::map<std::string, std::string>& data_sets) {
  const pcrb::FileBytes file(path);
  pcrb::LineReader lines(file.text(), path);
  const pcrb::ProblemKey key = keyOfFile(path, data_sets);
  std::string_view line;
  std::string_view command;
  bool has_line = lines.nextRow(line);
  if (has_line && startsWith(line, "#")) {
    command = line;
    has_line = lines.nextRow(line);
  }
  if (!has_line || !startsWith(line, kAuthorsHeader)) {
    lines.fail(has_line ? pcrb::inQuotes(line) : "nothing",
               std::string("a header ") + kAuthorsColumns);
  }
  Import import{method.empty() ? authorsMethod(path, command) : method, key.sequence, path, {}};
  while (lines.nextRow(line)) {
    import.problems.push_back(readAuthorsRow(lines, line));
    pcrb::ProblemKey& own = import.problems.back().key;
    own.data_set = key.data_set;
    own.sequence = key.sequence;
    own.kind = key.kind;
  }
  if (import.problems.empty()) throw pcrb::InvalidFile(path, 0, "no row", "one per problem");
  return import;
}

}  // namespace pcrb_tools
