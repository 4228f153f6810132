#include "datasets/named_columns.hpp"

#include <algorithm>
#include <cmath>

#include "datasets/pose_rows.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/csv.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb {
namespace {

/// The columns of a matrix's first three rows.
std::vector<std::string> matrixColumns(const std::string& prefix) {
  std::vector<std::string> columns;
  for (const char row : {'0', '1', '2'}) {
    for (const char column : {'0', '1', '2', '3'}) columns.push_back(prefix + row + column);
  }
  return columns;
}

}  // namespace

NamedColumns::NamedColumns(std::string_view text, const std::string& name, const Meaning& meaning,
                           const std::string& expected)
    : reader_(text, name) {
  do {
    if (!nextCsvRow(reader_, names_)) throw InvalidFile(name, 0, "no names", expected);
  } while (names_.size() == 1);
  for (std::size_t i = 0; i != names_.size(); ++i) places_.emplace(meaning(names_[i]), i);
}

bool NamedColumns::hasMatrix(const std::string& prefix) const {
  const auto columns = matrixColumns(prefix);
  return std::all_of(columns.begin(), columns.end(),
                     [this](const std::string& column) { return has(column); });
}

bool NamedColumns::next() {
  do {
    if (!nextCsvRow(reader_, fields_)) return false;
  } while (startsWith(fields_.front(), "#"));
  if (fields_.size() >= names_.size()) return true;
  reader_.fail(
      std::to_string(fields_.size()) + " fields, the first is " + inQuotes(fields_.front()),
      std::to_string(names_.size()) + " as in the row of names");
}

double NamedColumns::number(const std::string& meaning) const {
  const auto value = parseDouble(field(meaning));
  if (!value || !std::isfinite(*value)) {
    reader_.fail(inQuotes(field(meaning)) + " in column " + nameOf(meaning), "a number");
  }
  return *value;
}

Transform NamedColumns::pose(const std::string& prefix) const {
  std::vector<double> entries;
  for (const std::string& column : matrixColumns(prefix)) entries.push_back(number(column));
  return requireMatrixPose(reader_, entries);
}

}  // namespace pcrb
