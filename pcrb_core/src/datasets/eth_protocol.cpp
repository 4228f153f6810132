#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "datasets/pose_rows.hpp"
#include "pcrb_core/datasets/eth.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"

namespace pcrb {
namespace {

constexpr const char* kProtocolColumns = "columns reading, reference and iT00 to iT33";

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Finds columns by their names.
class Protocol {
 public:
  Protocol(std::string_view text, const std::string& name) : reader_(text, name) {
    std::vector<std::string> names;
    if (!nextCsvRow(reader_, names)) throw InvalidFile(name, 0, "no row", kProtocolColumns);
    for (std::size_t i = 0; i != names.size(); ++i) columns_.emplace(lowerCase(names[i]), i);
    prefix_ = columns_.count("it00") > 0 ? "it" : "t";
    for (const std::string& needed : neededColumns()) {
      if (columns_.count(needed) == 0) {
        reader_.fail("no column " + needed + " among " + joined(names), kProtocolColumns);
      }
    }
  }

  std::vector<EthProtocolRow> read() {
    std::vector<EthProtocolRow> rows;
    std::vector<std::string> fields;
    while (nextCsvRow(reader_, fields)) {
      if (fields.size() < columns_.size()) {
        reader_.fail(
            std::to_string(fields.size()) + " fields, the first is " + inQuotes(fields.front()),
            std::to_string(columns_.size()) + " as in the row of names");
      }
      rows.push_back({scan(fields, "reading"), scan(fields, "reference"), transform(fields)});
      if (rows.back().reading.frame != rows.back().reference.frame) {
        reader_.fail("scans in two frames", "both PointCloudN.csv or both Hokuyo_N.csv");
      }
    }
    if (rows.empty()) throw InvalidFile(reader_.name(), 0, "no row", "pairs of scans");
    return rows;
  }

 private:
  std::vector<std::string> neededColumns() const {
    std::vector<std::string> names{"reading", "reference"};
    for (const char row : {'0', '1', '2'}) {
      for (const char column : {'0', '1', '2', '3'}) names.push_back(prefix_ + row + column);
    }
    return names;
  }

  EthScanName scan(const std::vector<std::string>& fields, const std::string& column) const {
    const std::string& field = fields[columns_.at(column)];
    const auto name = parseEthScanName(field.substr(field.find_last_of("/\\") + 1));
    if (!name) reader_.fail(inQuotes(field), "a scan, PointCloudN.csv or Hokuyo_N.csv");
    return *name;
  }

  Transform transform(const std::vector<std::string>& fields) const {
    std::vector<double> entries;
    const auto names = neededColumns();
    for (std::size_t i = 2; i != names.size(); ++i) {
      const std::string& field = fields[columns_.at(names[i])];
      const auto number = parseDouble(field);
      if (!number || !std::isfinite(*number)) reader_.fail(inQuotes(field), "a number");
      entries.push_back(*number);
    }
    return requireMatrixPose(reader_, entries);
  }

  LineReader reader_;
  std::map<std::string, std::size_t> columns_;
  std::string prefix_;
};

}  // namespace

std::vector<EthProtocolRow> parseEthProtocol(std::string_view text, const std::string& name) {
  return Protocol(text, name).read();
}

}  // namespace pcrb
