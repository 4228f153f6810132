#pragma once

#include "conversion/conversion.hpp"

namespace pcrb_tools {

struct PlanetaryRequest : ConversionRequest {
  PlanetaryRequest() { data_set = "planetary"; }
};

/// Converts `box_met` or `p2at_met` of the planetary data set: `<set>_NNN.xyz` with `<set>_NNN.gt`
/// beside it, from folders and archives (one for all or one a scan).
///
/// @throws InvalidFile  for defects of the log, a scan without its pose, and scans of two sets.
ConversionReport convertPlanetary(const PlanetaryRequest& request);

}  // namespace pcrb_tools
