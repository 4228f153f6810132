#pragma once

#include <string>
#include <vector>

namespace pcrb {

/// Other nodes that publish one of the topics, each with what it does: `/map_loader publishes
/// /map`. Asks the master.
///
/// @throws Error  if the master does not answer.
std::vector<std::string> publishersBeside(const std::vector<std::string>& topics);

}  // namespace pcrb
