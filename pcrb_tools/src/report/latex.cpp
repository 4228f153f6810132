#include "report/latex.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "pcrb_core/io/text.hpp"

namespace pcrb_tools {
namespace {

constexpr std::size_t kWidestText = 28;  // letters; longer ones are broken, in a third of a line
constexpr std::size_t kRowsPerPage = 42;
constexpr std::size_t kUnbroken = 14;  // letters of a word, after which it may go on below

using Columns = std::vector<std::size_t>;  // positions

/// Letters that LaTeX reads otherwise or does not know.
const std::map<std::string, std::string> kLetters{{"\\", "\\textbackslash{}"},
                                                  {"<", "$<$"},
                                                  {">", "$>$"},
                                                  {"~", "\\~{}"},
                                                  {"^", "\\^{}"},
                                                  {"\n", " "},
                                                  {"\t", " "},
                                                  {"|", "$|$"},
                                                  {"[", "{[}"},  // or it would be an option of
                                                  {"*", "{*}"},  // the row's end before it
                                                  {"_", "\\_"},
                                                  {"%", "\\%"},
                                                  {"&", "\\&"},
                                                  {"#", "\\#"},
                                                  {"$", "\\$"},
                                                  {"{", "\\{"},
                                                  {"}", "\\}"},
                                                  {"°", "$^\\circ$"},
                                                  {"±", "$\\pm$"},
                                                  {"²", "$^2$"},
                                                  {"¹", "$^1$"},
                                                  {"⁻", "$^-$"},
                                                  {"ᵀ", "$^T$"},
                                                  {"χ", "$\\chi$"},
                                                  {"σ", "$\\sigma$"},
                                                  {"ρ", "$\\rho$"},
                                                  {"Δ", "$\\Delta$"},
                                                  {"µ", "$\\mu$"},
                                                  {"–", "--"},
                                                  {"…", "\\ldots{}"},
                                                  {"≤", "$\\le$"},
                                                  {"≥", "$\\ge$"},
                                                  {"×", "$\\times$"},
                                                  {"«", "$\\ll$"},
                                                  {"»", "$\\gg$"}};

/// Letters between U+00A0 and U+017E that LaTeX's usual fonts lack, with the nearest that they
/// have.
const std::map<std::string, std::string> kAbsentLetters{
    {"Ð", "D"}, {"ð", "d"}, {"Þ", "Th"}, {"þ", "th"}, {"Ą", "A"}, {"ą", "a"},
    {"Đ", "D"}, {"đ", "d"}, {"Ę", "E"},  {"ę", "e"},  {"Ħ", "H"}, {"ħ", "h"},
    {"Į", "I"}, {"į", "i"}, {"Ų", "U"},  {"ų", "u"},  {"ĸ", "k"}, {"Ŀ", "L"},
    {"ŀ", "l"}, {"ŉ", "n"}, {"Ŋ", "N"},  {"ŋ", "n"},  {"Ŧ", "T"}, {"ŧ", "t"}};

/// First and last letters of what LaTeX's usual fonts have: ASCII, and Latin from U+00A0 to U+017E.
const std::array<std::pair<std::string, std::string>, 2> kKnownRanges{
    {{" ", "~"}, {"\u00a0", "\u017e"}}};

/// Letters of UTF-8 of one length are ordered as their bytes are.
bool isKnownToLatex(const std::string& letter) {
  return std::any_of(kKnownRanges.begin(), kKnownRanges.end(), [&](const auto& range) {
    return letter.size() == range.first.size() && letter >= range.first && letter <= range.second;
  });
}

std::string latexLetter(const std::string& letter) {
  for (const auto* table : {&kLetters, &kAbsentLetters}) {
    const auto found = table->find(letter);
    if (found != table->end()) return found->second;
  }
  return isKnownToLatex(letter) ? letter : "?";
}

/// Bytes of the letter of UTF-8 that begins there; 1 for what is none.
std::size_t letterLength(const std::string& text, std::size_t at) {
  const auto first = static_cast<unsigned char>(text[at]);
  const std::size_t length = first < 0xC0 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  return std::min(length, text.size() - at);
}

/// Bytes of UTF-8 that begin a letter.
std::size_t letters(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::size_t widthOf(const Table& table, std::size_t column) {
  std::size_t width = letters(table.columns[column].name);
  for (const auto& row : table.rows) {
    width = std::max(width, letters(cellText(row[column], table.columns[column].format)));
  }
  return width;
}

/// Whether a column's texts are too long for one line each.
bool isBroken(const Table& table, std::size_t column) {
  return table.columns[column].format == Format::kText && widthOf(table, column) > kWidestText;
}

/// Letters that a column takes beside others.
std::size_t roomOf(const Table& table, std::size_t column) {
  return kLatexGap + (isBroken(table, column) ? kWidestText : widthOf(table, column));
}

std::string alignmentOf(const Table& table, const Columns& columns) {
  std::string alignment;
  for (const std::size_t i : columns) {
    const bool is_text = table.columns[i].format == Format::kText;
    alignment += isBroken(table, i) ? "p{0.34\\linewidth}" : is_text ? "l" : "r";
  }
  return alignment;
}

/// The first columns, of texts, name a row, as far as they leave half a line to the others.
std::size_t countKeys(const Table& table) {
  std::size_t count = 1;
  std::size_t room = roomOf(table, 0);
  while (count + 1 < table.columns.size() && table.columns[count].format == Format::kText) {
    room += roomOf(table, count);
    if (2 * room > kLatexLetters) break;
    ++count;
  }
  return count;
}

/// Columns that fit beside each other, those that name a row first in each part.
std::vector<Columns> columnParts(const Table& table) {
  const std::size_t keys = countKeys(table);
  Columns first;
  std::size_t key_width = 0;
  for (std::size_t i = 0; i < keys; ++i) {
    first.push_back(i);
    key_width += roomOf(table, i);
  }
  std::vector<Columns> parts{first};
  std::size_t width = key_width;
  for (std::size_t i = keys; i < table.columns.size(); ++i) {
    if (width + roomOf(table, i) > kLatexLetters && parts.back().size() > keys) {
      parts.push_back(first);
      width = key_width;
    }
    parts.back().push_back(i);
    width += roomOf(table, i);
  }
  return parts;
}

template <typename Cell>
std::string latexLine(const Table& table, const Columns& columns, const Cell& cell) {
  std::string text;
  for (const std::size_t column : columns) {
    const std::size_t unbroken = isBroken(table, column) ? kUnbroken : std::string::npos;
    text += (column == columns.front() ? "" : " & ") + latexEscaped(cell(column), unbroken);
  }
  return text + " \\\\\n";
}

std::string bodyOf(const Table& table, const Columns& columns, std::size_t begin, std::size_t end) {
  std::string body =
      latexLine(table, columns, [&](std::size_t i) { return table.columns[i].name; }) +
      "\\midrule\n";
  for (std::size_t row = begin; row < end; ++row) {
    body += latexLine(table, columns, [&](std::size_t i) {
      return cellText(table.rows[row][i], table.columns[i].format);
    });
  }
  return body;
}

}  // namespace

std::string latexEscaped(const std::string& text, std::size_t unbroken) {
  std::string escaped;
  std::size_t run = 0;  // letters since a place where a line may end
  for (std::size_t at = 0; at < text.size();) {
    const std::string letter = text.substr(at, letterLength(text, at));
    run = letter == " " ? 0 : run + 1;
    if (run > unbroken) {
      escaped += "\\hspace{0pt}";
      run = 1;
    }
    escaped += latexLetter(letter);
    at += letter.size();
  }
  return escaped;
}

Json latexRules() {
  Json letters(kLetters);
  letters.update(Json(kAbsentLetters));
  return {{"letters", letters}, {"ranges", Json(kKnownRanges)}, {"unbroken", kUnbroken}};
}

std::string latexTable(const std::string& caption, const std::string& label,
                       const std::string& columns, const std::string& body) {
  return "\\begin{table}[p]\n\\centering\\footnotesize\n\\caption{" + caption + "}\n\\label{" +
         label + "}\n\\begin{tabular}{" + columns + "}\n\\toprule\n" + body +
         "\\bottomrule\n\\end{tabular}\n\\end{table}\n\n";
}

std::string toLatex(const Table& table, const std::string& kind) {
  std::string text;
  std::size_t part = 0;
  for (const Columns& columns : columnParts(table)) {
    for (std::size_t begin = 0; begin < table.rows.size(); begin += kRowsPerPage) {
      ++part;
      const std::string number = part > 1 ? "-" + std::to_string(part) : "";
      const std::string note = part > 1 ? "continued." : latexEscaped(table.note);
      const std::size_t end = std::min(begin + kRowsPerPage, table.rows.size());
      text += latexTable(latexEscaped(table.title) + ", " + kind + " problems. " + note,
                         "tab:pcrb-" + kind + "-" + table.id + number, alignmentOf(table, columns),
                         bodyOf(table, columns, begin, end));
    }
    text += "\\clearpage\n\n";  // LaTeX keeps only so many floats at once
  }
  return text;
}

}  // namespace pcrb_tools
