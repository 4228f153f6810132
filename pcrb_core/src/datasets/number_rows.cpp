#include "datasets/number_rows.hpp"

#include <cmath>

#include "pcrb_core/io/number.hpp"

namespace pcrb {

std::string_view withoutByteOrderMark(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  const bool marked = text.substr(0, kByteOrderMark.size()) == kByteOrderMark;
  return marked ? text.substr(kByteOrderMark.size()) : text;
}

bool nextNotBlank(LineReader& reader, std::string_view& line) {
  while (reader.next(line)) {
    if (!trimmed(line).empty()) return true;
  }
  return false;
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
  if (!parseNumbers(line, separator, numbers)) reader.fail(inQuotes(line), expected);
  if (numbers.size() != count) reader.fail(std::to_string(numbers.size()) + " numbers", expected);
  for (const double number : numbers) {
    if (!std::isfinite(number)) reader.fail("a number that is not finite", expected);
  }
  return numbers;
}

}  // namespace pcrb
