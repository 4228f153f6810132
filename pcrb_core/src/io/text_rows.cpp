#include "pcrb_core/io/text_rows.hpp"

#include <utility>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

constexpr const char* kBlanks = " \t";
constexpr std::size_t kLongestQuote = 40;

}  // namespace

LineReader::LineReader(std::string_view text, std::string name)
    : rest_(text), name_(std::move(name)) {}

bool LineReader::next(std::string_view& line) {
  if (rest_.empty()) return false;
  ++line_number_;
  const std::size_t end = rest_.find('\n');
  line = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return true;
}

void LineReader::fail(const std::string& found, const std::string& expected) const {
  throw InvalidFile(name_, line_number_, found, expected);
}

void splitAtBlanks(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  std::size_t begin = line.find_first_not_of(kBlanks);
  while (begin != std::string_view::npos) {
    const std::size_t end = line.find_first_of(kBlanks, begin);
    fields.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kBlanks, end);
  }
}

void splitAt(char separator, std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  for (;;) {
    const std::size_t end = line.find(separator);
    fields.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) return;
    line.remove_prefix(end + 1);
  }
}

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

std::string inQuotes(std::string_view text) {
  constexpr const char* kHex = "0123456789abcdef";
  std::string quote = "'";
  for (const char c : text.substr(0, kLongestQuote)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7f) {
      quote += c;
    } else {
      quote += {'\\', 'x', kHex[byte >> 4], kHex[byte & 0xf]};
    }
  }
  if (text.size() > kLongestQuote) quote += "...";
  return quote + "'";
}

}  // namespace pcrb
