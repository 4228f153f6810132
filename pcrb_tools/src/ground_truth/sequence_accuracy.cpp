#include <map>

#include "ground_truth/ground_truth_tool.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb_tools {
namespace {

pcrb::TableRow tableRow(const SequenceAccuracy& sequence) {
  const pcrb::Statistics& kept = sequence.accuracy.kept;
  const auto length = [&](double value) {
    return sequence.isKnown() ? pcrb::formatFixed(value, 3) : "-";
  };
  return {sequence.data_set,
          sequence.sequence,
          std::to_string(sequence.pairs.pairs()),
          std::to_string(sequence.pairs.failed),
          std::to_string(sequence.accuracy.outliers),
          length(kept.median),
          length(kept.mean),
          length(kept.stddev)};
}

}  // namespace

void markWorst(std::vector<SequenceAccuracy>& sequences) {
  std::map<std::string, SequenceAccuracy*> worst;
  for (SequenceAccuracy& sequence : sequences) {
    if (!sequence.isKnown()) continue;
    SequenceAccuracy*& known = worst[sequence.data_set];
    if (known == nullptr || sequence.accuracy.kept.mean > known->accuracy.kept.mean) {
      known = &sequence;
    }
  }
  for (const auto& [data_set, sequence] : worst) sequence->is_worst = true;
}

std::string formatCsv(const std::vector<SequenceAccuracy>& sequences) {
  std::string text =
      "data_set,sequence,pairs,failed,outliers,median,mean,stddev,is_worst,translation_mean,"
      "translation_stddev,rotation_mean_deg,rotation_stddev_deg\n";
  for (const SequenceAccuracy& sequence : sequences) {
    const pcrb::Statistics& kept = sequence.accuracy.kept;
    text += sequence.data_set + "," + sequence.sequence + "," +
            std::to_string(sequence.pairs.pairs()) + "," + std::to_string(sequence.pairs.failed) +
            "," + std::to_string(sequence.accuracy.outliers);
    for (const double value : {kept.median, kept.mean, kept.stddev}) {
      text += ",";
      if (sequence.isKnown()) pcrb::appendShortest(text, value);
    }
    text += sequence.is_worst ? ",1" : ",0";
    for (const double value : {sequence.translation.mean, sequence.translation.stddev,
                               sequence.rotation_deg.mean, sequence.rotation_deg.stddev}) {
      text += ",";
      if (sequence.isKnown()) pcrb::appendShortest(text, value);
    }
    text += "\n";
  }
  return text;
}

std::string formatText(const std::vector<SequenceAccuracy>& sequences) {
  constexpr std::size_t kTextColumns = 2;
  std::vector<pcrb::TableRow> rows{
      {"data set", "sequence", "pairs", "failed", "outliers", "median m", "mean m", "stddev m"}};
  for (const SequenceAccuracy& sequence : sequences) rows.push_back(tableRow(sequence));
  std::string text = pcrb::alignColumns(rows, kTextColumns) + "\n";
  for (const SequenceAccuracy& sequence : sequences) {
    if (!sequence.isKnown()) {
      text += sequence.data_set + "/" + sequence.sequence + ": no pair aligned\n";
    }
    if (!sequence.is_worst) continue;
    const pcrb::Statistics& kept = sequence.accuracy.kept;
    text += sequence.data_set + ": " + pcrb::formatFixed(kept.mean, 2) + " ± " +
            pcrb::formatFixed(kept.stddev, 2) + " m (" + sequence.sequence + ")\n";
  }
  return text;
}

}  // namespace pcrb_tools
