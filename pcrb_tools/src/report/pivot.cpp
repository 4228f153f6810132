#include "report/pivot.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "report/latex.hpp"
#include "report/section_tables.hpp"

namespace pcrb_tools {
namespace {

using Mark = Pivot::Mark;

/// What the tests say of a selection: who is worse than whom, and whom they cannot tell apart.
struct Tests {
  std::set<std::pair<std::string, std::string>> worse;  ///< (worse, better)
  std::set<std::string> untold;                         ///< methods of tests that could not reject
};

std::map<std::string, Tests> testsBySelection(const Table& comparisons) {
  std::map<std::string, Tests> tests;
  const TableReader reader(comparisons);
  for (const auto& row : comparisons.rows) {
    const std::string a = reader.text(row, "a"), b = reader.text(row, "b");
    if (b == kBaseline) continue;  // which is no method: it is never marked
    Tests& found = tests[reader.text(row, "selection")];
    const std::string better = reader.text(row, "better");
    if (!better.empty()) found.worse.insert({better == a ? b : a, better});
    if (reader.text(row, "verdict") == kTooFewPairs) found.untold.insert({a, b});
  }
  return tests;
}

bool isTested(const Section& section, const Selection& selection) {
  const ProblemCounts counts = countProblems(section, selection);
  return counts.shared == counts.all &&
         (selection.level == "sequence" || selection.name == "total");
}

void markRow(const std::vector<std::string>& methods, const Tests& tests, Pivot::Row& row) {
  std::size_t best = methods.size(), known = 0;
  for (std::size_t i = 0; i < methods.size(); ++i) {
    if (!row.cells[i]) continue;
    ++known;
    if (best == methods.size() || row.cells[i]->median < row.cells[best]->median) best = i;
  }
  if (known < 2 || tests.untold.count(methods[best]) > 0) return;
  for (std::size_t i = 0; i < methods.size(); ++i) {
    if (!row.cells[i] || tests.worse.count({methods[i], methods[best]}) > 0) continue;
    row.cells[i]->mark = i == best ? Mark::kBest : Mark::kTie;
  }
}

Pivot::Cell cellOf(const TableReader& reader, const std::vector<Json>& row) {
  return {*reader.number(row, "median"), reader.number(row, "low"), reader.number(row, "high"),
          Mark::kNone};
}

const char* toString(Mark mark) {
  return mark == Mark::kBest ? "best" : mark == Mark::kTie ? "tie" : "";
}

std::string shown(double value) { return cellText(Json(value), Format::kError); }

/// A row's cells: those of the methods from `begin` to `end`, then the baseline's.
template <typename Dress>
std::vector<std::string> textsOf(const Pivot& pivot, const Pivot::Row& row, std::size_t begin,
                                 std::size_t end, const Dress& dress) {
  std::vector<std::string> texts;
  for (std::size_t i = begin; i < end; ++i) {
    texts.push_back(row.cells[i] ? dress(shown(row.cells[i]->median), row.cells[i]->mark) : "-");
  }
  if (pivot.has_baseline) texts.push_back(row.untouched ? shown(*row.untouched) : "-");
  return texts;
}

std::string dressedForLatex(const std::string& text, Mark mark) {
  if (mark == Mark::kNone) return text;
  return (mark == Mark::kBest ? "\\textbf{" : "\\textit{") + text + "}";
}

std::string joinedCells(const std::vector<std::string>& cells, const std::string& separator) {
  std::string line;
  for (const std::string& cell : cells) line += separator + cell;
  return line;
}

/// The first method that does not fit beside those from `begin` on; one fits at least.
std::size_t endOfPart(const Pivot& pivot, std::size_t begin) {
  static constexpr std::size_t kNumber = 8;  // letters, as 1.23e-05
  const auto room = [](const std::string& name) {
    return std::max(name.size(), kNumber) + kLatexGap;
  };
  std::size_t width = pivot.has_baseline ? room(kBaseline) : 0, widest = 0;
  for (const Pivot::Row& row : pivot.rows) widest = std::max(widest, row.name.size());
  width += widest + kLatexGap + room(pivot.methods[begin]);
  std::size_t end = begin + 1;
  while (end < pivot.methods.size() && width + room(pivot.methods[end]) <= kLatexLetters) {
    width += room(pivot.methods[end++]);
  }
  return end;
}

/// The table of the methods from `begin` to `end`.
std::string latexPart(const Pivot& pivot, const std::string& caption, const std::string& label,
                      std::size_t begin, std::size_t end) {
  std::vector<std::string> header;
  for (std::size_t i = begin; i < end; ++i) header.push_back(latexEscaped(pivot.methods[i]));
  if (pivot.has_baseline) header.push_back(kBaseline);
  std::string body = joinedCells(header, " & ") + " \\\\\n\\midrule\n", level;
  for (const Pivot::Row& row : pivot.rows) {
    if (!level.empty() && row.level != level) body += "\\midrule\n";
    level = row.level;
    body += latexEscaped(row.name) +
            joinedCells(textsOf(pivot, row, begin, end, dressedForLatex), " & ") + " \\\\\n";
  }
  return latexTable(caption, label, "l" + std::string(header.size(), 'r'), body);
}

}  // namespace

Pivot makePivot(const Section& section, const Table& scores, const Table& comparisons) {
  Pivot pivot;
  pivot.has_baseline = section.baseline.has_value();
  for (const Entry* entry : section.entries) pivot.methods.push_back(entry->method);
  const TableReader reader(scores);
  std::map<std::tuple<std::string, std::string, std::string>, Pivot::Cell> cells;
  for (const auto& row : scores.rows) {
    cells[{reader.text(row, "selection"), reader.text(row, "level"), reader.text(row, "method")}] =
        cellOf(reader, row);
  }
  const auto tests = testsBySelection(comparisons);
  for (const Selection& selection : section.selections) {
    const auto find = [&](const std::string& method) -> std::optional<Pivot::Cell> {
      const auto found = cells.find({selection.name, selection.level, method});
      if (found == cells.end()) return std::nullopt;
      return found->second;
    };
    Pivot::Row row{selection.name, selection.level, {}, {}};
    for (const std::string& method : pivot.methods) row.cells.push_back(find(method));
    if (const auto untouched = find(kBaseline)) row.untouched = untouched->median;
    const auto tested = tests.find(selection.name);
    if (tested != tests.end() && isTested(section, selection)) {
      markRow(pivot.methods, tested->second, row);
    }
    pivot.rows.push_back(std::move(row));
  }
  return pivot;
}

Json toJson(const Pivot& pivot) {
  Json list = Json::array();
  for (const Pivot::Row& row : pivot.rows) {
    Json json;
    json["name"] = row.name;
    json["level"] = row.level;
    json["cells"] = Json::array();
    for (const auto& cell : row.cells) {
      Json described = nullptr;
      if (cell) {
        described = {{"median", cell->median},
                     {"low", number(cell->low)},
                     {"high", number(cell->high)},
                     {"mark", toString(cell->mark)}};
      }
      json["cells"].push_back(described);
    }
    json["untouched"] = number(row.untouched);
    list.push_back(json);
  }
  return list;
}

std::string toMarkdown(const Pivot& pivot) {
  std::string text =
      "### Medians\n\nMedian error. Bold: the lowest; italic: not shown to be worse than it. Both "
      "only where a test could tell.\n\n| sequence |";
  for (const std::string& method : pivot.methods) text += " " + markdownEscaped(method) + " |";
  if (pivot.has_baseline) text += std::string(" ") + kBaseline + " |";
  text += "\n|---|";
  for (std::size_t i = 0; i < pivot.methods.size() + (pivot.has_baseline ? 1 : 0); ++i) {
    text += "---:|";
  }
  const auto dress = [](const std::string& cell, Mark mark) {
    const std::string star = mark == Mark::kBest ? "**" : mark == Mark::kTie ? "*" : "";
    return star + cell + star;
  };
  for (const Pivot::Row& row : pivot.rows) {
    text += "\n| " + markdownEscaped(row.name) +
            joinedCells(textsOf(pivot, row, 0, pivot.methods.size(), dress), " | ") + " |";
  }
  return text + "\n\n";
}

std::string toLatex(const Pivot& pivot, const std::string& kind) {
  std::string text;
  const std::size_t count = pivot.methods.size();
  for (std::size_t begin = 0, end = 0, part = 1; begin < count; begin = end, ++part) {
    end = endOfPart(pivot, begin);
    const std::string caption =
        "Median error of the " + kind +
        " problems, dimensionless (the mean distance of a source's points from where they belong, "
        "each divided by the point's distance from the centroid). Bold: the lowest of a row; "
        "italic: not shown to be worse (Wilcoxon's signed-rank test over pairs of clouds, $p \\ge "
        "0.05$ after Holm's correction)" +
        std::string(part > 1 ? "; continued." : ".");
    const std::string label =
        "tab:pcrb-" + kind + "-medians" + (part > 1 ? "-" + std::to_string(part) : "");
    text += latexPart(pivot, caption, label, begin, end);
  }
  return text;
}

}  // namespace pcrb_tools
