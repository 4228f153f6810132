#pragma once

#include <map>
#include <string>

#include "pcrb_core/datasets/stamp.hpp"
#include "pcrb_core/problem/presentation.hpp"

namespace pcrb_tools {

/// What a bag of problems does not say: with it the poses that come back are scored.
struct ProblemKey {
  struct Row {
    std::string public_id;
    std::string official_id;
  };

  std::string problem_file;  ///< its name, without folder
  std::string hash;          ///< of the problem file
  pcrb::PresentationKind presentation = pcrb::PresentationKind::kRegistration;
  bool upright = false;
  int subset = 0;                   ///< number of problems drawn, 0 = all
  int seed = 1;                     ///< of that draw
  std::string secret;               ///< 32 hexadecimal digits
  std::map<pcrb::Stamp, Row> rows;  ///< by the problem's stamp in the bag
};

std::string formatProblemKey(const ProblemKey& key);

/// @throws pcrb::InvalidFile  with line, what was found and what was expected.
ProblemKey readProblemKey(const std::string& path);

}  // namespace pcrb_tools
