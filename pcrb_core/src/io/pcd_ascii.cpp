#include <algorithm>
#include <cmath>
#include <future>
#include <string_view>

#include "io/large_pages.hpp"
#include "pcd_header.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"

namespace pcrb {
namespace {

constexpr const char* kBlanksAndLineEnds = " \t\r\n";
/// Bytes; below it a thread costs more than it saves.
constexpr std::size_t kSmallestChunk = 1 << 16;
constexpr std::size_t kCacheLine = 64;  // bytes

bool isSpace(char c) { return c == ' ' || c == '\t'; }
bool isLineEnd(char c) { return c == '\r' || c == '\n'; }

const char* skipToken(const char* text, const char* end) {
  while (text < end && !isSpace(*text) && !isLineEnd(*text)) ++text;
  return text;
}

/// Reads the tokens of one field.
struct Column {
  /// Reads a token; one past it, or nullptr if there is none, or no number where one is needed.
  ///
  /// @param is_odd  set if it is in an integer's column that nobody uses, and none of its type.
  const char* scan(const char* text, const char* end, double& value, bool& is_odd) const {
    if (field.use != PcdUse::kNone) return scanDouble(text, end, value);
    const char* const behind = skipToken(text, end);
    if (field.type != 'F' && !field.isPadding() && !is_odd) {
      is_odd = std::find_if(text, behind, [this](char c) {
                 return (c < '0' || c > '9') && (c != '-' || field.type != 'I');
               }) != behind;
    }
    return behind == text ? nullptr : behind;
  }

  PcdField field;
};

/// Whether a line, that does not end the text, has nothing in it.
bool isBlankLine(const char* line, const char* end) {
  const char* at = skipBlanks(line, end);
  if (at < end && *at == '\r') ++at;
  return at < end && *at == '\n';
}

/// What a part of the rows holds.
struct Part {
  std::vector<Eigen::Vector3d> points;
  std::vector<float> intensity;
  std::vector<double> times;
  std::size_t dropped = 0;
  std::size_t rows = 0;
  std::size_t blank_lines = 0;
  bool is_odd = false;              // an integer that nobody uses was none
  const char* malformed = nullptr;  // the first row that is, if any
};

/// On cache lines of its own: all threads read it, and one of them keeps its part beside it.
class alignas(kCacheLine) AsciiReader {
 public:
  AsciiReader(const PcdHeader& header, const LineReader& lines, const PcdReading& options)
      : lines_(lines), points_(header.points) {
    for (const PcdField& field : header.fields) {
      columns_.push_back({field});
      tokens_ += field.count;
      if (field.use == PcdUse::kTime) time_scale_ = field.timeScale();
    }
    has_intensity_ = header.has(PcdUse::kIntensity);
    const std::size_t bytes = lines.rest().size();
    share_ = takeMemory(lines, bytes + pointBytes(header, mostRows(bytes)), options);
  }

  void read(int threads, TimedCloud& cloud) const {
    // Empty lines behind the last row change nothing.
    const std::string_view text =
        lines_.rest().substr(0, lines_.rest().find_last_not_of(kBlanksAndLineEnds) + 1);
    std::vector<std::future<Part>> others;
    const std::vector<std::string_view> chunks = split(text, static_cast<std::size_t>(threads));
    for (std::size_t i = 1; i < chunks.size(); ++i) {
      others.push_back(std::async(
          std::launch::async, [&, i] { return readRows(chunks[i], mostRows(chunks[i].size())); }));
    }
    std::vector<Part> parts;
    // The others' rows are put behind these: there is room for them, and nothing moves.
    parts.push_back(readRows(chunks[0], mostRows(text.size())));
    for (auto& other : others) parts.push_back(other.get());
    check(parts, text);
    join(parts, cloud);
  }

 private:
  /// A token takes two bytes with what separates it: the header cannot claim memory.
  std::size_t mostRows(std::size_t bytes) const {
    return std::min(points_, bytes / (2 * tokens_) + 1);
  }

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

  /// @param most_rows  to have room for.
  Part readRows(std::string_view text, std::size_t most_rows) const {
    Part part;
    part.points.reserve(most_rows);
    preferLargePages(part.points.data(), most_rows * sizeof(Eigen::Vector3d));
    if (has_intensity_) part.intensity.reserve(most_rows);
    const char* const end = text.data() + text.size();
    double values[kPcdUses] = {};
    for (const char* row = text.data(); row < end;) {
      const char* const next = readRow(row, end, values, part.is_odd);
      if (next == nullptr && isBlankLine(row, end)) {
        row = std::find(row, end, '\n') + 1;
        ++part.blank_lines;
        continue;
      }
      if (next == nullptr) {
        part.malformed = row;
        return part;
      }
      ++part.rows;
      row = next;
      const Eigen::Vector3d point(values[0], values[1], values[2]);
      if (!std::isfinite(point.x()) || !std::isfinite(point.y()) || !std::isfinite(point.z())) {
        ++part.dropped;
        continue;
      }
      part.points.push_back(point);
      if (has_intensity_)
        part.intensity.push_back(
            static_cast<float>(values[static_cast<std::size_t>(PcdUse::kIntensity)]));
      if (time_scale_ > 0.0) {
        part.times.push_back(values[static_cast<std::size_t>(PcdUse::kTime)] * time_scale_);
      }
    }
    return part;
  }

  /// One past the row's end, or nullptr if the row is malformed.
  const char* readRow(const char* text, const char* end, double* values, bool& is_odd) const {
    for (const Column& column : columns_) {
      double& value = values[static_cast<std::size_t>(column.field.use)];
      for (std::size_t i = 0; i < column.field.count; ++i) {
        text = column.scan(skipBlanks(text, end), end, value, is_odd);
        if (text == nullptr) return nullptr;
        if (text < end && !isSpace(*text) && !isLineEnd(*text)) return nullptr;
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
        bool is_odd = false;
        const char* const end = token->data() + token->size();
        if (column.scan(token->data(), end, ignored, is_odd) != end) {
          throw InvalidFile(lines_.name(), line_number,
                            inQuotes(*token) + " for field " + inQuotes(column.field.name),
                            "a number");
        }
      }
    }
    throw InvalidFile(lines_.name(), line_number, inQuotes(line), "a row of points");
  }

  static void join(std::vector<Part>& parts, TimedCloud& cloud) {
    std::size_t points = 0;
    std::size_t blank_lines = 0;
    bool is_odd = false;
    for (const Part& part : parts) {
      points += part.points.size();
      blank_lines += part.blank_lines;
      is_odd = is_odd || part.is_odd;
      cloud.dropped_non_finite += part.dropped;
    }
    if (blank_lines > 0) cloud.notes.push_back(std::to_string(blank_lines) + " blank lines");
    if (is_odd) cloud.notes.emplace_back("an integer's column, not used, holds something else");
    cloud.points = std::move(parts[0].points);
    cloud.intensity = std::move(parts[0].intensity);
    cloud.times = std::move(parts[0].times);
    cloud.points.reserve(points);
    cloud.intensity.reserve(cloud.intensity.empty() ? 0 : points);
    for (std::size_t i = 1; i < parts.size(); ++i) {
      const Part part = std::move(parts[i]);  // its memory is free behind this
      cloud.points.insert(cloud.points.end(), part.points.begin(), part.points.end());
      cloud.intensity.insert(cloud.intensity.end(), part.intensity.begin(), part.intensity.end());
      cloud.times.insert(cloud.times.end(), part.times.begin(), part.times.end());
    }
  }

  const LineReader& lines_;
  std::size_t points_;
  std::vector<Column> columns_;
  std::size_t tokens_ = 0;  // values of a row
  bool has_intensity_ = false;
  double time_scale_ = 0.0;  // 0 = times are not kept
  MemoryBudget::Share share_;
};

}  // namespace

void readPcdAscii(const PcdHeader& header, const LineReader& lines, const PcdReading& options,
                  TimedCloud& cloud) {
  AsciiReader(header, lines, options).read(options.threads, cloud);
}

}  // namespace pcrb
