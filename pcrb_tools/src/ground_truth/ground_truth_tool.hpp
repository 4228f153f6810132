#pragma once

#include <cstddef>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "ground_truth/pair_evaluation.hpp"
#include "pcrb_core/evaluation/statistics.hpp"
#include "pcrb_core/problem/problem.hpp"

namespace pcrb_tools {

/// What `evaluate_ground_truth` is asked for.
struct GroundTruthOptions {
  std::string root;                      ///< folder of data sets; empty = imports only
  std::vector<std::string> sequences;    ///< data sets, sequences, or both as `a/b`; empty = all
  pcrb::Kind kind = pcrb::Kind::kLocal;  ///< of the problem files whose pairs are evaluated
  std::vector<std::string> imports;  ///< `<data set>=<path>/<sequence>.csv`, or `…_gt_check.dat`
  std::string output;                ///< folder, made where missing
  std::optional<double> radius;      ///< m, of the association; empty = the overlap distance
  std::size_t max_pairs = 0;         ///< per sequence, evenly over the file; 0 = all
  int threads = 1;
  bool force = false;  ///< replace files that somebody else made
};

/// Evaluates the ground truth of sequences as the paper's section 4 does: PPCR starts at the
/// ground-truth pose of each pair of clouds, without subsampling; the mean distance (m) by which it
/// moves the source's points is the pair's misalignment. Outliers are left out of a sequence's mean
/// and standard deviation; a data set is as good as its worst sequence.
///
/// Writes `<output>/pairs/<data set>_<sequence>.csv` (a row per pair; an interrupted run goes on
/// from its last pair, what is complete and unchanged is kept), then `ground_truth.csv`,
/// `ground_truth.txt` (which also goes to `out`), `ground_truth.svg` and `ground_truth_pairs.svg`
/// from them.
/// A pair that cannot be aligned is counted as failed, its reason is in pairs/.
/// @throws pcrb::Error  if a file is not as it should be, a wanted sequence is not there, or no
///                      pair of any sequence could be aligned.
void runGroundTruthTool(const GroundTruthOptions& options, std::ostream& out);

/// The ground truth of one sequence.
struct SequenceAccuracy {
  std::string data_set;
  std::string sequence;
  PairFile pairs;
  pcrb::GroundTruthAccuracy accuracy;  ///< nothing where no pair could be aligned
  pcrb::Statistics translation;        ///< m, of what the pairs' poses moved, outliers included
  pcrb::Statistics rotation_deg;       ///< the same in degrees
  bool is_worst = false;               ///< of its data set: stands for it in the paper's Table 1

  bool isKnown() const { return !pairs.misalignments.empty(); }
};

/// Marks the sequence with the largest mean of each data set; of equal ones the first.
void markWorst(std::vector<SequenceAccuracy>& sequences);

/// `data_set,sequence,pairs,failed,outliers,median,mean,stddev,is_worst,translation_mean,
/// translation_stddev,rotation_mean_deg,rotation_stddev_deg`: lengths in m, of the pairs that are
/// neither failed nor outliers (translations and rotations with outliers), empty where no pair
/// could be aligned. What `report` reads as each sequence's floor.
std::string formatCsv(const std::vector<SequenceAccuracy>& sequences);

/// The same as a table for a terminal, and a line per data set as in the paper's Table 1.
std::string formatText(const std::vector<SequenceAccuracy>& sequences);

/// A histogram of the misalignments per sequence that has some, with outliers apart, mean and
/// Gaussian: SVG.
std::string plotSvg(const std::vector<SequenceAccuracy>& sequences);

/// The paper's Fig. 2, a row per sequence: pairs on x; translation, rotation, misalignment, and
/// misalignment without outliers on y, each with its mean and the band of ± one standard deviation.
std::string plotPairsSvg(const std::vector<SequenceAccuracy>& sequences);

}  // namespace pcrb_tools
