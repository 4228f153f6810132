#include "datasets/line_reader.hpp"

#include <cmath>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"

namespace pcrb {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::size_t kQuotedLength = 60;

const char* skipBlanks(const char* at, const char* end) {
  while (at != end && isBlank(*at)) ++at;
  return at;
}

}  // namespace

LineReader::LineReader(std::string_view text, const std::string& name) : rest_(text), name_(name) {
  if (rest_.substr(0, kByteOrderMark.size()) == kByteOrderMark) {
    rest_.remove_prefix(kByteOrderMark.size());
  }
}

bool LineReader::next(std::string_view& line) {
  if (rest_.empty()) return false;
  const std::size_t end = rest_.find('\n');
  line = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  ++number_;
  return true;
}

bool LineReader::nextNotBlank(std::string_view& line) {
  while (next(line)) {
    if (!trim(line).empty()) return true;
  }
  return false;
}

void LineReader::fail(const std::string& found, const std::string& expected) const {
  throw InvalidFile(name_, number_, found, expected);
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

std::string quote(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text.substr(0, kQuotedLength)) {
    quoted += c >= ' ' && c <= '~' ? c : '?';
  }
  return quoted + (text.size() > kQuotedLength ? "…'" : "'");
}

bool parseNumbers(std::string_view line, Separator separator, std::vector<double>& numbers) {
  numbers.clear();
  const char* const end = line.data() + line.size();
  const char* at = skipBlanks(line.data(), end);
  while (at != end) {
    double value = 0.0;
    const char* const after = scanDouble(at, end, value);
    if (after == nullptr) return false;
    at = skipBlanks(after, end);
    const bool separated =
        separator == Separator::kBlanks ? at != after || at == end : at == end || *at == ',';
    if (!separated) return false;
    numbers.push_back(value);
    if (separator == Separator::kComma && at != end) at = skipBlanks(at + 1, end);
  }
  return true;
}

std::vector<double> requireNumbers(const LineReader& reader, std::string_view line,
                                   Separator separator, std::size_t count,
                                   const std::string& expected) {
  std::vector<double> numbers;
  numbers.reserve(count);
  if (!parseNumbers(line, separator, numbers)) reader.fail(quote(line), expected);
  if (numbers.size() != count) {
    reader.fail(std::to_string(numbers.size()) + " numbers", expected);
  }
  for (const double number : numbers) {
    if (!std::isfinite(number)) reader.fail("a number that is not finite", expected);
  }
  return numbers;
}

}  // namespace pcrb
