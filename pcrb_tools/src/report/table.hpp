#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace pcrb_tools {

using Json = nlohmann::ordered_json;

/// How a column's numbers look to people; CSV files always have the shortest exact form.
enum class Format { kText, kCount, kError, kFraction, kProbability, kSeconds, kPublished };

struct Column {
  std::string name;
  Format format = Format::kText;
};

/// One table of the report. A cell is a text, a number, or null where there is no value.
struct Table {
  std::string id;  ///< name of its file
  std::string title;
  std::string note;  ///< how to read it
  std::vector<Column> columns;
  std::vector<std::vector<Json>> rows;
};

/// Cells of a table's rows by the names of their columns.
class TableReader {
 public:
  explicit TableReader(const Table& table);

  const Json& cell(const std::vector<Json>& row, const std::string& column) const {
    return row.at(places_.at(column));
  }

  /// Empty where there is no value.
  std::string text(const std::vector<Json>& row, const std::string& column) const;
  std::optional<double> number(const std::vector<Json>& row, const std::string& column) const;

 private:
  std::map<std::string, std::size_t> places_;
};

/// A finite number, else null.
Json number(std::optional<double> value);

/// A quantile of ascending values; null of none.
Json quantileOf(const std::vector<double>& sorted, double q);

/// A cell as people read it, errors and times with three significant digits; `-` where there is no
/// value.
std::string cellText(const Json& cell, Format format);

std::string markdownEscaped(const std::string& text);

std::string toCsv(const Table& table);       ///< header and rows, RFC 4180
std::string toMarkdown(const Table& table);  ///< title, note, table
Json toJson(const Table& table);

}  // namespace pcrb_tools
