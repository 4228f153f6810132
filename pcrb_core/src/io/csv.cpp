#include "pcrb_core/io/csv.hpp"

#include <algorithm>

#include "pcrb_core/io/text.hpp"

namespace pcrb {
namespace {

/// Takes what stands before the closing quote, and that quote, off a line or several.
std::string takeQuoted(LineReader& lines, std::string_view& line) {
  const std::size_t opened = lines.lineNumber();
  std::string field;
  for (;;) {
    const std::size_t quote = line.find('"');
    field += line.substr(0, quote);
    if (quote == std::string_view::npos) {
      field += '\n';
      if (lines.next(line)) continue;
      lines.fail("no end of the quote that opens in line " + std::to_string(opened), "one");
    }
    line.remove_prefix(quote + 1);
    if (line.empty() || line.front() != '"') return field;
    field += '"';
    line.remove_prefix(1);
  }
}

/// Takes a field, not the comma behind it, off a line.
std::string takeField(LineReader& lines, std::string_view& line) {
  const bool is_quoted = startsWith(trimmed(line), "\"");
  std::string field;
  if (is_quoted) {
    line.remove_prefix(line.find('"') + 1);
    field = takeQuoted(lines, line);
  }
  const std::string_view rest = trimmed(line.substr(0, line.find(',')));
  if (is_quoted && !rest.empty()) lines.fail(inQuotes(rest) + " behind a quote", "a comma");
  line.remove_prefix(std::min(line.find(','), line.size()));
  return is_quoted ? field : std::string(rest);
}

}  // namespace

void appendCsvField(std::string& line, std::string_view field) {
  const bool is_plain = field.find_first_of(",\"\r\n") == std::string_view::npos;
  if (is_plain && trimmed(field).size() == field.size()) {
    line += field;
    return;
  }
  line += '"';
  for (const char character : field) line.append(character == '"' ? 2 : 1, character);
  line += '"';
}

bool nextCsvRow(LineReader& lines, std::vector<std::string>& fields) {
  std::string_view line;
  if (!lines.nextRow(line)) return false;
  fields = {takeField(lines, line)};
  while (!line.empty()) {
    line.remove_prefix(1);
    fields.push_back(takeField(lines, line));
  }
  return true;
}

}  // namespace pcrb
