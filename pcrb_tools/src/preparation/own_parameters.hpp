#pragma once

#include <ostream>

#include "conversion/own_request.hpp"
#include "preparation/preparation.hpp"

namespace pcrb_tools {

/// Writes the data set's `dataset.yaml`, or, where there is one or the data set is a published one,
/// holds the parameters that are asked for against it.
///
/// @throws InvalidParameter  if they contradict.
void settleParameters(const OwnRequest& request, const DatasetParameters& parameters,
                      std::ostream& out);

}  // namespace pcrb_tools
