#include <algorithm>
#include <cmath>
#include <cstdint>
#include <future>
#include <string_view>

#include "pcd_header.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"

namespace pcrb {
namespace {

constexpr const char* kBlanksAndLineEnds = " \t\r\n";
constexpr std::size_t kSmallestChunk = 1
                                       << 16;  // bytes; below it a thread costs more than it saves

constexpr std::size_t kCacheLine = 64;  // bytes

bool isBlank(char c) { return c == ' ' || c == '\t'; }
bool isLineEnd(char c) { return c == '\r' || c == '\n'; }

const char* skipBlanks(const char* text, const char* end) {
  while (text < end && isBlank(*text)) ++text;
  return text;
}

const char* skipToken(const char* text, const char* end) {
  while (text < end && !isBlank(*text) && !isLineEnd(*text)) ++text;
  return text;
}

/// Where the values of a row go.
enum Slot { kX, kY, kZ, kIntensity, kIgnored, kSlots };

/// What the tokens of one field must be.
struct Column {
  explicit Column(const PcdField& described)
      : field(described), slot(slotOf(described)), is_padding(described.isPadding()) {}

  /// Reads a token; one past it, or nullptr if it is none or not of this column's type.
  const char* scan(const char* text, const char* end, double& value) const {
    if (field.type == 'F' && !is_padding) return scanDouble(text, end, value);
    const char* const behind = skipToken(text, end);
    const std::string_view token(text, static_cast<std::size_t>(behind - text));
    const bool is_good = is_padding ? !token.empty() : parseInteger(token, value);
    return is_good ? behind : nullptr;
  }

  /// What a token of this column must be, for messages.
  std::string expected() const {
    if (field.type == 'F') return "a number";
    const std::string bits = std::to_string(8 * field.size);
    return (field.type == 'I' ? "a signed integer of " : "an unsigned integer of ") + bits +
           " bits";
  }

  PcdField field;
  Slot slot;
  bool is_padding;

 private:
  static Slot slotOf(const PcdField& field) {
    if (field.name == "x") return kX;
    if (field.name == "y") return kY;
    if (field.name == "z") return kZ;
    return field.name == "intensity" ? kIntensity : kIgnored;
  }

  bool parseInteger(std::string_view token, double& value) const {
    const auto unused_bits = static_cast<int>(64 - 8 * field.size);
    if (field.type == 'I') {
      const auto parsed = parseInt(token);
      if (!parsed || *parsed > INT64_MAX >> unused_bits || *parsed < INT64_MIN >> unused_bits) {
        return false;
      }
      value = static_cast<double>(*parsed);
      return true;
    }
    const auto parsed = parseUnsigned(token);
    if (!parsed || *parsed > UINT64_MAX >> unused_bits) return false;
    value = static_cast<double>(*parsed);
    return true;
  }
};

/// What a part of the rows holds.
struct Part {
  std::vector<Eigen::Vector3d> points;
  std::vector<float> intensity;
  std::size_t dropped = 0;
  std::size_t rows = 0;
  const char* malformed = nullptr;  // the first row that is, if any
};

/// On cache lines of its own: all threads read it, and one of them keeps its part beside it.
class alignas(kCacheLine) AsciiReader {
 public:
  AsciiReader(const PcdHeader& header, const LineReader& lines)
      : lines_(lines), points_(header.points) {
    for (const PcdField& field : header.fields) {
      columns_.emplace_back(field);
      tokens_ += field.count;
      has_intensity_ = has_intensity_ || columns_.back().slot == kIntensity;
    }
  }

  void read(int threads, DatasetCloud& cloud) const {
    // Empty lines behind the last row change nothing.
    const std::string_view text =
        lines_.rest().substr(0, lines_.rest().find_last_not_of(kBlanksAndLineEnds) + 1);
    std::vector<std::future<Part>> others;
    const std::vector<std::string_view> chunks = split(text, static_cast<std::size_t>(threads));
    for (std::size_t i = 1; i < chunks.size(); ++i) {
      others.push_back(std::async(std::launch::async, [&, i] { return readRows(chunks[i]); }));
    }
    std::vector<Part> parts;
    parts.push_back(readRows(chunks[0]));
    for (auto& other : others) parts.push_back(other.get());
    check(parts, text);
    join(parts, cloud);
  }

 private:
  /// Cuts a text behind line ends into up to `count` parts of about the same size.
  static std::vector<std::string_view> split(std::string_view text, std::size_t count) {
    count = std::min(count, text.size() / kSmallestChunk + 1);
    std::vector<std::string_view> chunks;
    for (; count > 1; --count) {
      const std::size_t end = text.find('\n', text.size() / count);
      if (end == std::string_view::npos) break;
      chunks.push_back(text.substr(0, end + 1));
      text.remove_prefix(end + 1);
    }
    chunks.push_back(text);
    return chunks;
  }

  Part readRows(std::string_view text) const {
    Part part;
    // A token takes two bytes with what separates it: the header cannot claim memory.
    const std::size_t most_rows = std::min(points_, text.size() / (2 * tokens_) + 1);
    part.points.reserve(most_rows);
    if (has_intensity_) part.intensity.reserve(most_rows);
    const char* const end = text.data() + text.size();
    double values[kSlots] = {};
    for (const char* row = text.data(); row < end; ++part.rows) {
      const char* const next = readRow(row, end, values);
      if (next == nullptr) {
        part.malformed = row;
        return part;
      }
      row = next;
      const Eigen::Vector3d point(values[kX], values[kY], values[kZ]);
      if (!std::isfinite(point.x()) || !std::isfinite(point.y()) || !std::isfinite(point.z())) {
        ++part.dropped;
        continue;
      }
      part.points.push_back(point);
      if (has_intensity_) part.intensity.push_back(static_cast<float>(values[kIntensity]));
    }
    return part;
  }

  /// One past the row's end, or nullptr if the row is malformed.
  const char* readRow(const char* text, const char* end, double* values) const {
    for (const Column& column : columns_) {
      for (std::size_t i = 0; i < column.field.count; ++i) {
        text = column.scan(skipBlanks(text, end), end, values[column.slot]);
        if (text == nullptr) return nullptr;
        if (text < end && !isBlank(*text) && !isLineEnd(*text)) return nullptr;
      }
    }
    text = skipBlanks(text, end);
    if (text < end && *text == '\r') ++text;
    if (text == end) return end;
    return *text == '\n' ? text + 1 : nullptr;
  }

  void check(const std::vector<Part>& parts, std::string_view text) const {
    std::size_t rows = 0;
    for (const Part& part : parts) {
      if (part.malformed != nullptr) explain(part.malformed, text);
      rows += part.rows;
    }
    if (rows != points_) {
      const char* const end = text.data() + text.size();
      throw InvalidFile(lines_.name(), text.empty() ? lines_.lineNumber() : lineOf(end, text),
                        std::to_string(rows) + " rows of points",
                        std::to_string(points_) + " as POINTS says");
    }
  }

  std::size_t lineOf(const char* position, std::string_view text) const {
    return lines_.lineNumber() + 1 +
           static_cast<std::size_t>(std::count(text.data(), position, '\n'));
  }

  /// Says what is wrong with a malformed row.
  [[noreturn]] void explain(const char* row, std::string_view text) const {
    const std::size_t line_number = lineOf(row, text);
    std::string_view line = text.substr(static_cast<std::size_t>(row - text.data()));
    line = line.substr(0, line.find('\n'));
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    std::vector<std::string_view> tokens;
    splitAtBlanks(line, tokens);
    if (tokens.size() != tokens_) {
      throw InvalidFile(lines_.name(), line_number, std::to_string(tokens.size()) + " values",
                        std::to_string(tokens_));
    }
    auto token = tokens.begin();
    for (const Column& column : columns_) {
      for (std::size_t i = 0; i < column.field.count; ++i, ++token) {
        double ignored = 0.0;
        const char* const end = token->data() + token->size();
        if (column.scan(token->data(), end, ignored) != end) {
          throw InvalidFile(lines_.name(), line_number,
                            inQuotes(*token) + " for field " + inQuotes(column.field.name),
                            column.expected());
        }
      }
    }
    throw InvalidFile(lines_.name(), line_number, inQuotes(line), "a row of points");
  }

  static void join(std::vector<Part>& parts, DatasetCloud& cloud) {
    cloud.points = std::move(parts[0].points);
    cloud.intensity = std::move(parts[0].intensity);
    cloud.dropped_non_finite = parts[0].dropped;
    for (std::size_t i = 1; i < parts.size(); ++i) {
      const Part& part = parts[i];
      cloud.points.insert(cloud.points.end(), part.points.begin(), part.points.end());
      cloud.intensity.insert(cloud.intensity.end(), part.intensity.begin(), part.intensity.end());
      cloud.dropped_non_finite += part.dropped;
    }
  }

  const LineReader& lines_;
  std::size_t points_;
  std::vector<Column> columns_;
  std::size_t tokens_ = 0;  // values of a row
  bool has_intensity_ = false;
};

}  // namespace

void readPcdAscii(const PcdHeader& header, const LineReader& lines, int threads,
                  DatasetCloud& cloud) {
  AsciiReader(header, lines).read(threads, cloud);
}

}  // namespace pcrb
