#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "pcrb_core/datasets/stamp.hpp"
#include "pcrb_core/problem/presentation.hpp"
#include "pcrb_core/problem/secret.hpp"

namespace pcrb_tools {

/// What a bag of problems does not say: with it the poses that come back are scored.
struct ProblemKey {
  struct Row {
    std::string public_id;
    std::string official_id;
  };

  std::string problem_file;  ///< its name, without folder
  std::string hash;          ///< of the problem file
  pcrb::PresentationOptions presentation;
  std::size_t subset = 0;              ///< number of problems drawn, 0 = all
  std::uint64_t seed = 1;              ///< of that draw
  std::optional<pcrb::Secret> secret;  ///< of ids, order and sensor poses
  std::map<pcrb::Stamp, Row> rows;     ///< by the problem's stamp in the bag
};

std::string formatProblemKey(const ProblemKey& key);

/// @throws pcrb::InvalidFile  with line, what was found and what was expected.
ProblemKey readProblemKey(const std::string& path);

}  // namespace pcrb_tools
