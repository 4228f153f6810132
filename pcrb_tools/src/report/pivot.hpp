#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/section.hpp"
#include "report/table.hpp"

namespace pcrb_tools {

/// The medians as a paper has them: a row per selection, a column per method.
struct Pivot {
  /// How a median stands in its row, where a test could tell: all methods have the same problems,
  /// which are of a sequence or all, and enough pairs of clouds.
  enum class Mark { kNone, kBest, kTie };  ///< kTie: not shown to be worse than the best

  struct Cell {
    double median = 0.0;
    std::optional<double> low, high;  ///< of the 95 % interval
    Mark mark = Mark::kNone;
  };

  struct Row {
    std::string name;
    std::string level;  ///< sequence, data set, group or total
    std::vector<std::optional<Cell>> cells;
    std::optional<double> untouched;  ///< of the baseline
  };

  std::vector<std::string> methods;
  bool has_baseline = false;
  std::vector<Row> rows;
};

/// @param scores       scoreTable() of the section.
/// @param comparisons  comparisonTable() of the section.
Pivot makePivot(const Section& section, const Table& scores, const Table& comparisons);

Json toJson(const Pivot& pivot);
std::string toMarkdown(const Pivot& pivot);

/// Tables with booktabs, the best in bold, what is not shown to be worse in italics; so many
/// methods beside each other as fit a page.
///
/// @param kind  of the problems: part of captions and labels.
std::string toLatex(const Pivot& pivot, const std::string& kind);

}  // namespace pcrb_tools
