#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "pcrb_core/problem/overlap_matrix.hpp"
#include "pcrb_core/problem/problem.hpp"
#include "pcrb_core/random.hpp"

namespace pcrb {

/// File name of the cloud of a folder that is a map and no scan (docs/formats.md, Planetary).
constexpr const char* kMapCloud = "box_map.pcd";

/// A source, a target and their overlap in [0, 1].
struct CloudPair {
  std::string source;  ///< file name
  std::string target;  ///< file name
  double overlap = 0.0;
};

/// Pairs drawn for each kind of list. Source: Fontana et al. 2021, section 3.3.
constexpr std::size_t kPairsPerList = 100;

/// Number of intervals of overlap that pairs are drawn from evenly.
constexpr std::size_t kOverlapIntervals = 10;

/// Smallest overlap of a pair: 0.4 for local, 0.6 for global problems.
double minimalOverlap(Kind kind);

/// Pairs of different clouds whose overlap is known, at least minimalOverlap(kind) and below 1, in
/// the matrix' order, row by row.
std::vector<CloudPair> eligiblePairs(const OverlapMatrix& matrix, Kind kind);

/// The ten equal intervals of [min, max] of the pairs' overlaps, half-open but for the last: the
/// interval of each pair, 0 … 9.
///
/// @throws InvalidProblem  if there is no pair.
std::vector<std::size_t> overlapIntervals(const std::vector<CloudPair>& pairs);

/// Where the pairs come from that an interval lacks.
enum class TopUp {
  kEven,  ///< from the intervals with the fewest drawn pairs that have some left
  kPaper  ///< from all that are left, whatever their interval: dense intervals get more
};

/// Draws pairs evenly from the ten intervals of their overlaps, without replacement.
///
/// Ten pairs (for 100) come from each interval; what an interval lacks, as TopUp says. Pairs repeat
/// only when there are fewer than `count`: all are drawn once before any is drawn again. The result
/// is sorted by interval.
/// @throws InvalidProblem  if there is no pair.
/// Source: Fontana et al. 2021, section 3.3.
std::vector<CloudPair> samplePairs(const std::vector<CloudPair>& eligible, std::size_t count,
                                   Random& random, TopUp top_up = TopUp::kEven);

}  // namespace pcrb
