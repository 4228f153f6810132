#include "pcrb_core/problem/problem.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <unordered_map>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb {

const char* toString(Kind kind) { return kind == Kind::kLocal ? "local" : "global"; }

Kind kindFromString(const std::string& text) {
  if (text == "local") return Kind::kLocal;
  if (text == "global") return Kind::kGlobal;
  throw InvalidParameter("kind: found " + inQuotes(text) + ", expected 'local' or 'global'");
}

namespace {

constexpr std::string_view kHeader =
    "id source target overlap t1 t2 t3 t4 t5 t6 t7 t8 t9 t10 t11 t12";
constexpr std::size_t kTransformStart = 4;
constexpr std::size_t kFieldCount = 16;
constexpr int kOverlapDecimals = 4;

constexpr const char* kIdRule = "an id of 2 to 20 decimal digits";
constexpr const char* kNameRule = "a file name without folder, blanks or control characters";
constexpr const char* kOverlapRule = "an overlap between 0 and 1";
constexpr const char* kEntryRule = "a finite number";

bool isId(std::string_view text) {
  return text.size() >= 2 && text.size() <= 20 &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

bool isPlainFileName(std::string_view text) {
  const auto is_allowed = [](char c) {
    return static_cast<unsigned char>(c) > 0x20 && c != 0x7f && c != '/';
  };
  return !text.empty() && text != "." && text != ".." &&
         std::all_of(text.begin(), text.end(), is_allowed);
}

bool isOverlap(double value) { return value >= 0.0 && value <= 1.0; }

void checkHeader(LineReader& lines) {
  std::string_view line;
  if (!lines.nextRow(line))
    lines.fail("an empty file", "the header '" + std::string(kHeader) + "'");
  std::vector<std::string_view> expected;
  std::vector<std::string_view> found;
  splitAtBlanks(kHeader, expected);
  splitAtBlanks(line, found);
  if (found != expected) lines.fail(inQuotes(line), "'" + std::string(kHeader) + "'");
}

double finiteNumber(const LineReader& lines, std::string_view text, const std::string& column) {
  const auto value = parseDouble(text);
  if (!value || !std::isfinite(*value)) {
    lines.fail(inQuotes(text) + " in column " + column, kEntryRule);
  }
  return *value;
}

Problem parseRow(const LineReader& lines, const std::vector<std::string_view>& fields) {
  if (fields.size() != kFieldCount) {
    lines.fail(std::to_string(fields.size()) + " fields",
               "16: id, source, target, overlap and 12 transform entries");
  }
  if (!isId(fields[0])) lines.fail(inQuotes(fields[0]), kIdRule);
  for (const unsigned name : {1u, 2u}) {
    if (!isPlainFileName(fields[name])) lines.fail(inQuotes(fields[name]), kNameRule);
  }
  Problem problem;
  problem.id = fields[0];
  problem.source = fields[1];
  problem.target = fields[2];
  problem.overlap = finiteNumber(lines, fields[3], "overlap");
  if (!isOverlap(problem.overlap)) lines.fail(inQuotes(fields[3]), kOverlapRule);
  for (std::size_t i = 0; i < 12; ++i) {
    problem.perturbation(static_cast<Eigen::Index>(i / 4), static_cast<Eigen::Index>(i % 4)) =
        finiteNumber(lines, fields[kTransformStart + i], "t" + std::to_string(i + 1));
  }
  return problem;
}

/// A row that readProblemFile would refuse must not be written.
void requireWritable(const Problem& problem) {
  const auto require = [&](bool ok, const char* what, const char* rule) {
    if (!ok) {
      throw InvalidProblem("problem " + inQuotes(problem.id) + ": " + what + ", expected " + rule);
    }
  };
  require(isId(problem.id), "found an impossible id", kIdRule);
  require(isPlainFileName(problem.source), "found an impossible source", kNameRule);
  require(isPlainFileName(problem.target), "found an impossible target", kNameRule);
  require(isOverlap(problem.overlap), "found an impossible overlap", kOverlapRule);
  require(problem.perturbation.allFinite(), "found an impossible transform entry", kEntryRule);
}

std::uint32_t crc32(std::string_view text) {
  constexpr std::uint32_t kReversedPolynomial = 0xedb88320;
  std::uint32_t crc = 0xffffffff;
  for (const char c : text) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) ? kReversedPolynomial : 0);
  }
  return ~crc;
}

}  // namespace

std::vector<Problem> readProblemFile(const std::string& path) {
  const FileBytes file(path);
  return parseProblemFile(file.begin(), file.end(), path);
}

std::vector<Problem> parseProblemFile(const char* begin, const char* end, const std::string& name) {
  LineReader lines({begin, static_cast<std::size_t>(end - begin)}, name);
  checkHeader(lines);
  std::vector<Problem> problems;
  std::unordered_map<std::string_view, std::size_t> line_of_id;
  std::vector<std::string_view> fields;
  std::string_view line;
  while (lines.nextRow(line)) {
    splitAtBlanks(line, fields);
    problems.push_back(parseRow(lines, fields));
    const auto [first, is_new] = line_of_id.emplace(fields[0], lines.lineNumber());
    if (!is_new) {
      lines.fail(
          "id " + problems.back().id + " of line " + std::to_string(first->second) + " again",
          "an id of its own");
    }
  }
  if (problems.empty()) lines.fail("no problem", "at least one row after the header");
  return problems;
}

std::string formatProblemFile(const std::vector<Problem>& problems) {
  std::string text(kHeader);
  text += '\n';
  for (const Problem& problem : problems) {
    requireWritable(problem);
    text += problem.id + ' ' + problem.source + ' ' + problem.target + ' ';
    appendFixed(text, problem.overlap, kOverlapDecimals);
    for (Eigen::Index i = 0; i < 12; ++i) {
      text += ' ';
      appendShortest(text, problem.perturbation(i / 4, i % 4));
    }
    text += '\n';
  }
  return text;
}

void writeProblemFile(const std::string& path, const std::vector<Problem>& problems) {
  writeFileAtomically(path, formatProblemFile(problems));
}

std::string problemId(const std::string& sequence, std::size_t index, std::size_t pairs) {
  if (index >= 31 * pairs) {
    throw InvalidParameter("problem index: found " + std::to_string(index) +
                           ", expected below 31 * " + std::to_string(pairs) + " pairs");
  }
  const std::string digits = std::to_string(index);
  const std::size_t width = std::to_string(31 * pairs - 1).size();
  return std::to_string(crc32(sequence)) + std::string(width - digits.size(), '0') + digits;
}

}  // namespace pcrb
