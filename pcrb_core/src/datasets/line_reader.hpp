#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace pcrb {

/// The lines of a text in memory, without their ends (LF or CRLF) and without a byte order mark.
class LineReader {
 public:
  /// @param name  stands for the path in messages; must outlive the reader
  LineReader(std::string_view text, const std::string& name);

  /// The next line, or false at the end. A last line without an end counts, an empty one does not.
  bool next(std::string_view& line);

  /// The next line that is not blank.
  bool nextNotBlank(std::string_view& line);

  /// Number of the line that was read last, from 1.
  std::size_t number() const { return number_; }

  /// Throws InvalidFile for the line that was read last.
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const;

 private:
  std::string_view rest_;
  const std::string& name_;
  std::size_t number_ = 0;
};

inline bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

std::string_view trim(std::string_view text);

/// The text in quotes and printable, cut to a length that a message can bear.
std::string quote(std::string_view text);

enum class Separator { kBlanks, kComma };

/// All numbers of a line. Blanks around numbers are accepted, and a comma after the last one;
/// nothing else is.
/// @return  false if a part is no number; `numbers` then holds those before it.
bool parseNumbers(std::string_view line, Separator separator, std::vector<double>& numbers);

/// The numbers of the reader's line.
/// @throws InvalidFile  unless there are exactly `count`, all finite.
std::vector<double> requireNumbers(const LineReader& reader, std::string_view line,
                                   Separator separator, std::size_t count,
                                   const std::string& expected);

}  // namespace pcrb
