#include "pcrb_core/datasets/eth.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>

#include "datasets/log_rows.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb {
namespace {

constexpr std::size_t kPoseColumns = 18;
constexpr double kMaxScanNumber = 1e9;

/// Which coordinate each column of a scan file is: 0, 1, 2 or kOther.
constexpr int kOther = -1;
using Columns = std::vector<int>;

std::string_view trimQuotes(std::string_view text) {
  text = trimmed(text);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') {
    text = trimmed(text.substr(1, text.size() - 2));
  }
  return text;
}

int coordinateOf(std::string_view column) {
  column = trimQuotes(column);
  if (column.size() != 1) return kOther;
  const int axis = std::tolower(static_cast<unsigned char>(column[0])) - 'x';
  return axis >= 0 && axis < 3 ? axis : kOther;
}

Columns parseHeader(const LineReader& reader, std::string_view header) {
  Columns columns;
  std::string_view line = header;
  std::array<int, 3> found{};
  for (bool more = true; more;) {
    const std::size_t comma = line.find(',');
    const int axis = coordinateOf(line.substr(0, comma));
    if (axis != kOther) ++found[static_cast<std::size_t>(axis)];
    columns.push_back(axis);
    more = comma != std::string_view::npos;
    if (more) line.remove_prefix(comma + 1);
  }
  if (found != std::array<int, 3>{1, 1, 1}) {
    reader.fail(inQuotes(header), "a header with one column each of x, y and z");
  }
  return columns;
}

/// Reads a number that may have blanks and quotes around it; `at` ends at the comma or the end.
///
/// @param text_end  of the text that the line is in: scanning is faster where it may look ahead,
///                  and no number goes beyond its line.
bool scanCell(const char*& at, const char* end, const char* text_end, double& value) {
  const auto skip = [&at, end] {
    while (at != end && (*at == ' ' || *at == '\t' || *at == '"')) ++at;
  };
  skip();
  const char* const after = scanDouble(at, text_end, value);
  if (after == nullptr) return false;
  at = after;
  skip();
  return at == end || *at == ',';
}

const char* findComma(const char* at, const char* end) {
  const void* const comma = std::memchr(at, ',', static_cast<std::size_t>(end - at));
  return comma == nullptr ? end : static_cast<const char*>(comma);
}

Eigen::Vector3d parseRow(const LineReader& reader, std::string_view line, const Columns& columns) {
  Eigen::Vector3d point;
  const char* at = line.data();
  const char* const end = at + line.size();
  const char* const text_end = reader.rest().data() + reader.rest().size();
  for (std::size_t column = 0; column != columns.size(); ++column) {
    if (column > 0) {
      if (at == end) {
        reader.fail(std::to_string(column) + " columns in " + inQuotes(line),
                    std::to_string(columns.size()));
      }
      ++at;  // the comma
    }
    if (columns[column] == kOther) {
      at = findComma(at, end);
    } else if (!scanCell(at, end, text_end, point[columns[column]])) {
      reader.fail(inQuotes(line), "a number in column " + std::to_string(column + 1));
    }
  }
  if (at != end && !trimmed({at + 1, static_cast<std::size_t>(end - at - 1)}).empty()) {
    const auto more = std::count(at, end, ',');
    reader.fail(std::to_string(columns.size() + static_cast<std::size_t>(more)) + " columns in " +
                    inQuotes(line),
                std::to_string(columns.size()));
  }
  return point;
}

std::uint64_t requireScanNumber(const LineReader& reader, double number) {
  // Some files write ids with decimals.
  if (number < 0.0 || number > kMaxScanNumber || number != std::floor(number)) {
    reader.fail("scan number " + formatShortest(number), "a whole number from 0");
  }
  return static_cast<std::uint64_t>(number);
}

std::optional<std::uint64_t> numberBetween(std::string_view text, std::string_view prefix,
                                           std::string_view suffix) {
  if (text.size() <= prefix.size() + suffix.size() || !startsWith(text, prefix) ||
      !endsWith(text, suffix)) {
    return std::nullopt;
  }
  return parseUnsigned(text.substr(prefix.size(), text.size() - prefix.size() - suffix.size()));
}

bool isNamedAfter(std::string_view file_name, const EthSequence& sequence) {
  if (startsWith(file_name, sequence.log_name)) return true;
  if (!startsWith(file_name, sequence.name)) return false;
  const std::string_view rest = file_name.substr(sequence.name.size());
  return rest.empty() || rest[0] == '.' || rest[0] == '-' ||
         (rest[0] == '_' && rest.size() > 1 && rest[1] >= '0' && rest[1] <= '9');
}

}  // namespace

std::optional<EthScanName> parseEthScanName(std::string_view file_name) {
  if (const auto number = numberBetween(file_name, "PointCloud", ".csv")) {
    return EthScanName{EthFrame::kGlobal, *number};
  }
  if (const auto number = numberBetween(file_name, "Hokuyo_", ".csv")) {
    return EthScanName{EthFrame::kLocal, *number};
  }
  return std::nullopt;
}

std::string ethCloudName(std::uint64_t number) {
  return "PointCloud" + std::to_string(number) + ".pcd";
}

SensorScan parseEthScan(std::string_view text, const std::string& name) {
  LineReader reader(text, name);
  std::string_view line;
  if (!reader.nextRow(line)) throw InvalidFile(name, 0, "no line", "a header and points");
  const Columns columns = parseHeader(reader, line);
  SensorScan scan;
  while (reader.nextRow(line)) {
    if (scan.points.empty()) scan.points.reserve(reader.rest().size() / (line.size() + 1) + 1);
    scan.add(parseRow(reader, line, columns), OriginPoints::kKeep);
  }
  if (scan.counts.read == 0) throw InvalidFile(name, 0, "a header only", "points");
  return scan;
}

std::map<std::uint64_t, Transform> parseLeicaPoses(std::string_view text, const std::string& name) {
  const std::string expected = "18 numbers: poseId, timestamp, T00 ... T33";
  std::map<std::uint64_t, Transform> poses;
  LineReader reader(text, name);
  std::string_view line;
  std::vector<double> numbers;
  if (reader.nextRow(line) && parseNumbers(line, Separator::kComma, numbers)) {
    reader.fail("numbers in the first line", "a header");
  }
  while (reader.nextRow(line)) {
    numbers = requireNumbers(reader, line, Separator::kComma, kPoseColumns, expected);
    const std::uint64_t number = requireScanNumber(reader, numbers[0]);
    if (!poses.emplace(number, requireLogPose4x4(reader, &numbers[2])).second) {
      reader.fail("poseId " + std::to_string(number) + " again", "each poseId once");
    }
  }
  if (poses.empty()) throw InvalidFile(name, 0, "no pose", "a header and rows of " + expected);
  return poses;
}

const std::vector<EthSequence>& ethSequences() {
  static const std::vector<EthSequence> sequences = {
      {"apartment", "apartment_03-Dec-2011-18_13_33", 45},
      {"gazebo_summer", "gazebo_summer_04-Aug-2011-16_13_22", 32},
      {"gazebo_winter", "gazebo_winter_18-Jan-2012-16_10_04", 31},
      {"hauptgebaude", "ETH_hauptgebaude_23-Aug-2011-18_43_49", 36},
      {"plain", "plain_01-Sep-2011-16_39_18", 31},
      {"stairs", "stairs_26-Aug-2011-14_26_14", 31},
      {"wood_autumn", "wood_autumn_09-Dec-2011-15_44_05", 32},
      {"wood_summer", "wood_summer_25-Aug-2011-13_00_30", 37}};
  return sequences;
}

std::string ethSequenceName(std::string_view file_name) {
  for (const auto& sequence : ethSequences()) {
    if (isNamedAfter(file_name, sequence)) return sequence.name;
  }
  return {};
}

}  // namespace pcrb
