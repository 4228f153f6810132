#include "report/table.hpp"

#include <algorithm>
#include <cmath>

#include "pcrb_core/evaluation/statistics.hpp"
#include "pcrb_core/io/csv.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb_tools {
namespace {

const char* toString(Format format) {
  switch (format) {
    case Format::kText:
      return "text";
    case Format::kCount:
      return "count";
    case Format::kError:
      return "error";
    case Format::kFraction:
      return "fraction";
    case Format::kProbability:
      return "probability";
    case Format::kSeconds:
      return "seconds";
    case Format::kPublished:
      return "published";
  }
  return "text";
}

/// Three significant digits, and never 0.000 for what is not 0.
std::string threeDigits(double value) {
  constexpr double kLargestFixed = 1e5;
  constexpr double kSmallestFixed = 1e-4;
  if (value == 0.0) return "0";
  const std::string rounded = pcrb::formatScientific(value, 2);  // 9.999 has become 1.00e+01
  const double size = std::abs(*pcrb::parseDouble(rounded));
  if (size < kSmallestFixed || size >= kLargestFixed) return rounded;
  const int decimals = 2 - static_cast<int>(std::floor(std::log10(size)));
  return pcrb::formatFixed(value, std::max(0, decimals));
}

/// Three decimals, as most fractions need them; three digits where these would all be 0.
std::string fractionText(double value) {
  constexpr double kSmallest = 0.0005;
  return std::abs(value) < kSmallest ? threeDigits(value) : pcrb::formatFixed(value, 3);
}

std::string probabilityText(double value) {
  constexpr double kSmallest = 0.001;
  return value < kSmallest ? "<0.001" : pcrb::formatFixed(value, 3);
}

/// A field of CSV, quoted where it must be.
std::string csvField(const Json& cell) {
  if (cell.is_null()) return "";
  if (cell.is_number_float()) return pcrb::formatShortest(cell.get<double>());
  if (cell.is_number()) return std::to_string(cell.get<std::int64_t>());
  std::string field;
  pcrb::appendCsvField(field, cell.get_ref<const std::string&>());
  return field;
}

template <typename Escape>
std::string joined(const Table& table, const std::vector<Json>* row, const char* separator,
                   const Escape& escape) {
  std::string line;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const Column& column = table.columns[i];
    if (i > 0) line += separator;
    line += escape(row == nullptr ? column.name : cellText(row->at(i), column.format));
  }
  return line;
}

}  // namespace

TableReader::TableReader(const Table& table) {
  for (std::size_t i = 0; i < table.columns.size(); ++i) places_[table.columns[i].name] = i;
}

std::string TableReader::text(const std::vector<Json>& row, const std::string& column) const {
  const Json& found = cell(row, column);
  return found.is_string() ? found.get<std::string>() : std::string();
}

std::optional<double> TableReader::number(const std::vector<Json>& row,
                                          const std::string& column) const {
  const Json& found = cell(row, column);
  if (!found.is_number()) return std::nullopt;
  return found.get<double>();
}

std::string markdownEscaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (std::string("|_*<`\\").find(c) != std::string::npos) escaped += '\\';
    escaped += c == '\n' ? ' ' : c;
  }
  return escaped;
}

Json number(std::optional<double> value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

Json quantileOf(const std::vector<double>& sorted, double q) {
  return sorted.empty() ? Json(nullptr) : number(pcrb::quantile(sorted, q));
}

std::string cellText(const Json& cell, Format format) {
  if (cell.is_null()) return "-";
  if (cell.is_string()) return cell.get<std::string>();
  if (format == Format::kCount) return std::to_string(cell.get<std::int64_t>());
  const double value = cell.get<double>();
  if (format == Format::kProbability) return probabilityText(value);
  if (format == Format::kFraction) return fractionText(value);
  if (format == Format::kPublished) return pcrb::formatFixed(value, 2);
  return threeDigits(value);
}

std::string toCsv(const Table& table) {
  std::string text;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    text += (i > 0 ? "," : "") + csvField(Json(table.columns[i].name));
  }
  text += '\n';
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) text += (i > 0 ? "," : "") + csvField(row[i]);
    text += '\n';
  }
  return text;
}

std::string toMarkdown(const Table& table) {
  std::string text = "### " + table.title + "\n\n" + table.note + "\n\n| " +
                     joined(table, nullptr, " | ", markdownEscaped) + " |\n|";
  for (const Column& column : table.columns) {
    text += column.format == Format::kText ? "---|" : "---:|";
  }
  text += '\n';
  for (const auto& row : table.rows) {
    text += "| " + joined(table, &row, " | ", markdownEscaped) + " |\n";
  }
  return text + "\n";
}

Json toJson(const Table& table) {
  Json json;
  json["id"] = table.id;
  json["title"] = table.title;
  json["note"] = table.note;
  json["columns"] = Json::array();
  for (const Column& column : table.columns) {
    Json described;
    described["name"] = column.name;
    described["format"] = toString(column.format);
    json["columns"].push_back(described);
  }
  json["rows"] = Json::array();
  for (const auto& row : table.rows) json["rows"].push_back(row);
  return json;
}

}  // namespace pcrb_tools
