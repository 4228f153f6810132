#include "pcrb_core/problem/overlap_matrix.hpp"

#include <cmath>
#include <limits>
#include <string_view>
#include <unordered_set>
#include <utility>

#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb {
namespace {

constexpr std::string_view kCorner = "overlap";

std::vector<std::string> parseHeader(LineReader& lines) {
  std::string_view line;
  const std::string expected = "the header 'overlap' and the names of the clouds";
  if (!lines.nextRow(line)) lines.fail("an empty file", expected);
  std::vector<std::string_view> fields;
  splitAtBlanks(line, fields);
  if (fields.size() < 2 || fields[0] != kCorner) lines.fail(inQuotes(line), expected);
  std::unordered_set<std::string_view> seen;
  for (auto name = fields.begin() + 1; name != fields.end(); ++name) {
    if (name->find('/') != std::string_view::npos) {
      lines.fail(inQuotes(*name), "a file name without folder");
    }
    if (!seen.insert(*name).second) lines.fail(inQuotes(*name) + " twice", "every cloud once");
  }
  return {fields.begin() + 1, fields.end()};
}

double parseValue(const LineReader& lines, std::string_view text) {
  const auto value = parseDouble(text);
  if (!value || *value < 0.0 || *value > 1.0) {
    lines.fail(inQuotes(text), "an overlap between 0 and 1, or nan");
  }
  return *value;
}

void parseRow(const LineReader& lines, const std::vector<std::string>& names, std::size_t row,
              const std::vector<std::string_view>& fields, std::vector<double>& values) {
  if (row == names.size()) {
    lines.fail("one more row", std::to_string(names.size()) + " rows, as the header has names");
  }
  if (fields.size() != names.size() + 1) {
    lines.fail(std::to_string(fields.size()) + " fields",
               "a name and " + std::to_string(names.size()) + " overlaps");
  }
  if (fields[0] != names[row]) {
    lines.fail("row " + inQuotes(fields[0]), inQuotes(names[row]) + ", in the header's order");
  }
  for (std::size_t i = 1; i < fields.size(); ++i) values.push_back(parseValue(lines, fields[i]));
}

void appendValue(std::string& text, double value) {
  if (value == 0.0 || value == 1.0) {
    appendFixed(text, value, 1);
  } else {
    appendShortest(text, value);
  }
}

}  // namespace

OverlapMatrix::OverlapMatrix(std::vector<std::string> cloud_names)
    : names(std::move(cloud_names)),
      values(names.size() * names.size(), std::numeric_limits<double>::quiet_NaN()) {
  for (std::size_t i = 0; i < names.size(); ++i) at(i, i) = 1.0;
}

OverlapMatrix readOverlapMatrix(const std::string& path) {
  const FileBytes file(path);
  return parseOverlapMatrix(file.begin(), file.end(), path);
}

OverlapMatrix parseOverlapMatrix(const char* begin, const char* end, const std::string& name) {
  LineReader lines({begin, static_cast<std::size_t>(end - begin)}, name);
  OverlapMatrix matrix;
  matrix.names = parseHeader(lines);
  std::vector<std::string_view> fields;
  std::string_view line;
  std::size_t row = 0;
  while (lines.nextRow(line)) {
    splitAtBlanks(line, fields);
    parseRow(lines, matrix.names, row++, fields, matrix.values);
  }
  if (row != matrix.names.size()) {
    lines.fail(std::to_string(row) + " rows",
               std::to_string(matrix.names.size()) + ", as the header has names");
  }
  return matrix;
}

std::string formatOverlapMatrix(const OverlapMatrix& matrix) {
  std::string text(kCorner);
  for (const std::string& name : matrix.names) text += ' ' + name;
  text += '\n';
  for (std::size_t source = 0; source < matrix.names.size(); ++source) {
    text += matrix.names[source];
    for (std::size_t target = 0; target < matrix.names.size(); ++target) {
      text += ' ';
      appendValue(text, matrix.at(source, target));
    }
    text += '\n';
  }
  return text;
}

void writeOverlapMatrix(const std::string& path, const OverlapMatrix& matrix) {
  writeFileAtomically(path, formatOverlapMatrix(matrix));
}

}  // namespace pcrb
