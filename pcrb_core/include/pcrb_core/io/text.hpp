#pragma once

#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace pcrb {

/// Walks over the lines of a text in memory and knows where it is: the one way in for every text
/// format.
///
/// Lines end with LF or CRLF, the last one perhaps with neither; a byte order mark of UTF-8 is
/// passed over.
class LineReader {
 public:
  /// @param name  the file's path, for messages.
  /// @throws InvalidFile  if this is no text of lines, naming what it is: UTF-16, lone carriage
  ///                      returns as line ends, or, in place of the data, an HTML page, a Git LFS
  ///                      pointer or an archive.
  LineReader(std::string_view text, std::string name);

  /// Takes the next line, without its end; false behind the last one.
  bool next(std::string_view& line);

  /// Takes the next line that has more than spaces and tabs in it; false behind the last one.
  bool nextRow(std::string_view& line);

  /// The same of what is no comment, which begins with `#`; without blanks at its ends.
  bool nextDataRow(std::string_view& line);

  /// Number of the line taken last, from 1; 0 before the first.
  std::size_t lineNumber() const { return line_number_; }

  /// What follows the line taken last.
  std::string_view rest() const { return rest_; }

  const std::string& name() const { return name_; }

  /// @throws InvalidFile  always, for the line taken last.
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const;

 private:
  std::string_view rest_;
  std::string name_;
  std::size_t line_number_ = 0;
};

/// Replaces `fields` by the parts of a line between runs of spaces and tabs.
void splitAtBlanks(std::string_view line, std::vector<std::string_view>& fields);

/// The parts of a line between runs of spaces and tabs.
std::vector<std::string> splitAtBlanks(std::string_view line);

/// Replaces `fields` by the parts of a line between separators, blanks around them removed; an
/// empty line is one empty field.
void splitAt(char separator, std::string_view line, std::vector<std::string_view>& fields);

/// One past the blanks at the start of [at, end).
inline const char* skipBlanks(const char* at, const char* end) {
  while (at != end && (*at == ' ' || *at == '\t')) ++at;
  return at;
}

/// The text without spaces and tabs at its ends.
std::string_view trimmed(std::string_view text);

inline bool startsWith(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

inline bool endsWith(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

/// The text with small letters for ASCII's capitals.
std::string inSmallLetters(std::string_view text);

/// The parts one behind the other, with a separator between them: `a, b, c`.
/// @tparam Texts  a range of std::string.
template <typename Texts>
std::string joined(const Texts& parts, std::string_view separator = ", ") {
  std::string text;
  for (const auto& part : parts) {
    if (&part != &*std::begin(parts)) text += separator;
    text += part;
  }
  return text;
}

/// A text in quotes for a message: shortened to 40 bytes, non-printable bytes in hexadecimal.
std::string inQuotes(std::string_view text);

using TableRow = std::vector<std::string>;

/// A table for a terminal: a line per row, columns two spaces apart, each as wide as its widest
/// entry (UTF-8 characters count as one).
///
/// @param rows          all of the same length, at least one.
/// @param text_columns  so many columns at the left are aligned left, the others right.
std::string alignColumns(const std::vector<TableRow>& rows, std::size_t text_columns);

/// A stranger's text, made such that JSON and XML can hold it: each byte that is no UTF-8, each
/// control character but tab, line feed and carriage return, and U+FFFE and U+FFFF become U+FFFD.
std::string printableText(std::string_view text);

/// @param reason  why nothing else will do: it ends the message.
/// @throws InvalidParameter  if printableText() would change the text.
void requireUtf8(std::string_view text, const std::string& reason);

}  // namespace pcrb
