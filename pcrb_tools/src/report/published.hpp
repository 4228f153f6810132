#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "pcrb_core/problem/problem.hpp"

namespace pcrb_tools {

/// Place of a sequence in the paper's tables; those that are not in them come after all that are.
std::size_t publishedPlace(const std::string& sequence);

/// Data sets by their sequences: those of the paper, and of the problem files below `root`.
///
/// @param root  empty = only what is built in.
/// @throws pcrb::InvalidFile  if the root is no readable folder.
std::map<std::string, std::string> knownSequences(const std::string& root);

/// Whether a sequence of that name in that data set is one of the paper's, and how many these are.
bool isInPaper(const std::string& data_set, const std::string& sequence);
std::size_t paperSequenceCount();

/// What a sequence has in common with others, to group results by: environment and structure of the
/// paper's sequences (this suite's own assignment), sensor and characteristics of its data set
/// (`dataset.yaml` below `root`).
///
/// @param root  empty = only what is built in.
std::vector<std::string> characteristicsOf(const std::string& root, const std::string& data_set,
                                           const std::string& sequence);

/// One row of the paper's tables of results.
struct PublishedRow {
  std::string method;
  pcrb::Kind kind = pcrb::Kind::kLocal;
  std::string sequence;
  std::array<double, 5> statistics{};  ///< median, q75, q95, mean, stddev
};

/// One row of the paper's Table 8: Spearman's ρ over all problems of all sequences.
struct PublishedCorrelation {
  std::string method;
  pcrb::Kind kind = pcrb::Kind::kLocal;
  double misalignment = 0.0;
  double overlap = 0.0;
};

/// Tables 4-7 (local) and 9-11 (global). Source: Fontana et al. 2021.
std::vector<PublishedRow> publishedRows();

/// Table 8. Source: Fontana et al. 2021.
std::vector<PublishedCorrelation> publishedCorrelations();

}  // namespace pcrb_tools
