#include <algorithm>
#include <set>
#include <string>

#include "pcrb_core/evaluation/statistics.hpp"
#include "pcrb_core/io/text.hpp"
#include "report/published.hpp"
#include "report/section_tables.hpp"

namespace pcrb_tools {
namespace {

std::vector<Json> sequenceRow(const Section& section, const Selection& selection,
                              const std::string& root) {
  const auto& [data_set, sequence] = *selection.sequences.begin();
  const auto words = characteristicsOf(root, data_set, sequence);
  std::set<std::string> pairs;
  for (const Entry* entry : section.entries) {
    for (const ScoredProblem* problem : select(*entry, selection)) pairs.insert(problem->pair);
  }
  std::vector<Json> row{
      selection.name, data_set, pcrb::joined(words), "", countProblems(section, selection).all,
      pairs.size()};
  if (!words.empty()) row[3] = isInPaper(data_set, sequence) ? "this suite" : "dataset.yaml";
  std::vector<double> overlaps = overlapsOfProblems(section, selection);
  std::sort(overlaps.begin(), overlaps.end());
  for (const double q : {0.0, 0.5, 1.0}) {
    row.push_back(quantileOf(overlaps, q));
  }
  return row;
}

}  // namespace

Table sequenceTable(const Section& section, const std::string& root) {
  Table table{
      "sequences",
      "The sequences",
      "What the paper's Tables 2 and 3 are about. Characteristics are not the paper's: they "
      "are this suite's own assignment, from what the places are known to be, or those of a "
      "dataset.yaml. Problems, pairs and overlaps are those of the results above.",
      {{"sequence"},
       {"data set"},
       {"characteristics"},
       {"assigned by"},
       {"problems", Format::kCount},
       {"pairs", Format::kCount},
       {"least overlap", Format::kFraction},
       {"median overlap", Format::kFraction},
       {"largest overlap", Format::kFraction}},
      {}};
  for (const Selection* selection : section.at({"sequence"})) {
    table.rows.push_back(sequenceRow(section, *selection, root));
  }
  return table;
}

}  // namespace pcrb_tools
