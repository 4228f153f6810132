#pragma once

#include <string>
#include <vector>

#include "ground_truth/pair_file.hpp"
#include "pcrb_core/evaluation/statistics.hpp"

namespace pcrb_tools {

/// The ground truth of one sequence.
struct SequenceAccuracy {
  std::string data_set;
  std::string sequence;
  PairFile pairs;
  pcrb::GroundTruthAccuracy accuracy;  ///< nothing where no pair could be aligned
  bool is_worst = false;               ///< of its data set: stands for it in the paper's Table 1

  bool isKnown() const { return !pairs.misalignments.empty(); }
};

/// Marks the sequence with the largest mean of each data set; of equal ones the first.
void markWorst(std::vector<SequenceAccuracy>& sequences);

/// `data_set,sequence,pairs,failed,outliers,median,mean,stddev,is_worst`: lengths in m, of the
/// pairs that are neither failed nor outliers, empty where no pair could be aligned. What `report`
/// reads as each sequence's floor.
std::string formatCsv(const std::vector<SequenceAccuracy>& sequences);

/// The same as a table for a terminal, and a line per data set as in the paper's Table 1.
std::string formatText(const std::vector<SequenceAccuracy>& sequences);

/// A histogram of the misalignments per sequence that has some, with outliers apart, mean and
/// Gaussian: SVG.
std::string plotSvg(const std::vector<SequenceAccuracy>& sequences);

}  // namespace pcrb_tools
