#pragma once

#include <array>
#include <string>
#include <vector>

#include "pcrb_core/problem/problem.hpp"

namespace pcrb_tools {

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
