#pragma once

#include <string>

#include "pcrb_core/transform.hpp"

namespace pcrb_tools {

/// A pose for fingerprints: equal texts mean equal bits.
std::string poseText(const pcrb::Transform& pose);

}  // namespace pcrb_tools
