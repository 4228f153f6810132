#include "pcrb_core/io/text.hpp"

#include <algorithm>
#include <array>
#include <boost/locale/utf.hpp>
#include <utility>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/foreign_data.hpp"

namespace pcrb {
namespace {

constexpr const char* kBlanks = " \t";
constexpr std::size_t kLongestQuote = 40;

bool beginsWith(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

std::string_view withoutByteOrderMark(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  return beginsWith(text, kByteOrderMark) ? text.substr(kByteOrderMark.size()) : text;
}

/// UTF-16 of either byte order, with its mark or, as every other byte of a first word, without.
bool isUtf16(std::string_view text) {
  if (beginsWith(text, "\xFF\xFE") || beginsWith(text, "\xFE\xFF")) return true;
  if (text.size() < 4) return false;
  const auto is_zero = [&](std::size_t i) { return text[i] == '\0'; };
  return (is_zero(0) && is_zero(2) && !is_zero(1) && !is_zero(3)) ||
         (is_zero(1) && is_zero(3) && !is_zero(0) && !is_zero(2));
}

bool isPage(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  const std::string start = inSmallLetters(text.substr(0, 14));
  constexpr std::array<std::string_view, 4> kStarts{"<!doctype html", "<html", "<head", "<!--"};
  return std::any_of(kStarts.begin(), kStarts.end(),
                     [&](std::string_view with) { return beginsWith(start, with); });
}

/// A page of XHTML, or the answer of a store of objects.
bool isXml(std::string_view text) { return beginsWith(text, "<?xml"); }

bool isLfsPointer(std::string_view text) { return beginsWith(text, "version https://git-lfs"); }

/// Of gzip, whose third byte says deflate, or zip.
bool isArchive(std::string_view text) {
  return beginsWith(text, "\x1F\x8B\x08") || beginsWith(text, "PK\x03\x04");
}

bool hasLoneCarriageReturns(std::string_view text) {
  const std::size_t first = text.find_first_of("\r\n");
  if (first == std::string_view::npos || first + 1 == text.size()) return false;
  return text[first] == '\r' && text.find('\n') == std::string_view::npos;
}

/// What a file is that has no lines of data in it, and what to do about it; nothing for others.
std::pair<const char*, const char*> describeForeign(std::string_view text) {
  if (isUtf16(text)) return {"UTF-16 text", "UTF-8 (iconv -f UTF-16 -t UTF-8)"};
  if (isPage(text)) {
    return {"an HTML page", "data: the download gave a page, of an error or to confirm, instead"};
  }
  if (isXml(text)) return {"a page of XML", "data: the download gave a page, of an error, instead"};
  if (isLfsPointer(text)) {
    return {"a Git LFS pointer", "the file that it stands for (git lfs pull)"};
  }
  if (isArchive(text)) {
    return {"a compressed archive", "what is in it"};
  }
  if (hasLoneCarriageReturns(text)) {
    return {"lone carriage returns as line ends", "line feeds (tr '\\r' '\\n')"};
  }
  return {nullptr, nullptr};
}

}  // namespace

LineReader::LineReader(std::string_view text, std::string name)
    : rest_(withoutByteOrderMark(text)), name_(std::move(name)) {
  const auto [found, expected] = describeForeign(rest_);
  if (found != nullptr) throw InvalidFile(name_, 1, found, expected);
}

void requireData(std::string_view start, const std::string& name) {
  if (!isPage(start) && !isXml(start) && !isLfsPointer(start) && !isArchive(start)) return;
  const auto [found, expected] = describeForeign(start);
  throw InvalidFile(name, 0, found, expected);
}

void requireDataFile(const std::string& path) {
  constexpr std::size_t kEnough = 512;  // bytes
  const auto start = startOfFile(path, kEnough);
  if (!start) throw InvalidFile(path, "cannot be read");
  if (start->empty()) throw InvalidFile(path, 0, "an empty file", "data");
  if (!isArchive(*start)) requireData(*start, path);
}

bool LineReader::next(std::string_view& line) {
  if (rest_.empty()) return false;
  ++line_number_;
  const std::size_t end = rest_.find('\n');
  line = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return true;
}

bool LineReader::nextRow(std::string_view& line) {
  while (next(line)) {
    if (line.find_first_not_of(kBlanks) != std::string_view::npos) return true;
  }
  return false;
}

bool LineReader::nextDataRow(std::string_view& line) {
  while (nextRow(line)) {
    line = trimmed(line);
    if (line.front() != '#') return true;
  }
  return false;
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

std::vector<std::string> splitAtBlanks(std::string_view line) {
  std::vector<std::string_view> fields;
  splitAtBlanks(line, fields);
  return {fields.begin(), fields.end()};
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

std::string inSmallLetters(std::string_view text) {
  std::string small(text);
  for (char& c : small) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return small;
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

namespace {

/// Number of characters of a UTF-8 text.
std::size_t displayWidth(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned>(c) & 0xC0u) != 0x80u;
  }));
}

}  // namespace

std::string alignColumns(const std::vector<TableRow>& rows, std::size_t text_columns) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const TableRow& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], displayWidth(row[i]));
    }
  }
  std::string text;
  for (const TableRow& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string padding(widths[i] - displayWidth(row[i]), ' ');
      if (i > 0) text += "  ";
      text += i < text_columns ? row[i] + padding : padding + row[i];
    }
    text += '\n';
  }
  return text;
}

namespace {

namespace utf = boost::locale::utf;

bool isCharacter(utf::code_point c) { return c != utf::illegal && c != utf::incomplete; }

bool isPrintable(utf::code_point c) {
  if (c == '\t' || c == '\n' || c == '\r') return true;
  return isCharacter(c) && c >= 0x20 && c != 0x7f && c != 0xfffe && c != 0xffff;
}

}  // namespace

std::string printableText(std::string_view text) {
  constexpr const char* kReplacement = "\xef\xbf\xbd";
  std::string result;
  const char* const end = text.data() + text.size();
  for (const char* at = text.data(); at != end;) {
    const char* behind = at;
    const utf::code_point c = utf::utf_traits<char>::decode(behind, end);
    if (!isCharacter(c)) behind = at + 1;  // what follows that byte may be one
    if (isPrintable(c)) {
      result.append(at, behind);
    } else {
      result += kReplacement;
    }
    at = behind;
  }
  return result;
}

void requireUtf8(std::string_view text, const std::string& reason) {
  const std::string printable = printableText(text);
  if (printable == text) return;
  throw InvalidParameter("found `" + printable + "`, expected UTF-8: " + reason);
}

}  // namespace pcrb
