#pragma once

#include <optional>

#include "conversion/conversion.hpp"
#include "pcrb_core/datasets/eth.hpp"

namespace pcrb_tools {

struct EthRequest : ConversionRequest {
  EthRequest() { data_set = "eth"; }

  /// Which scan files are read; nothing = the global ones if there are any.
  std::optional<pcrb::EthFrame> frame;
};

/// Converts a sequence of the ETH data set: `csv_global`, or `csv_local` with the Leica poses, from
/// folders and archives (flat or with these folders).
///
/// VIEWPOINT is the scanner's pose where `pose_scanner_leica.csv` is among the files.
/// @throws InvalidFile  for defects of the log; what was complete before stays.
/// @throws InvalidParameter  if the sequence is not given and not in the names.
ConversionReport convertEth(const EthRequest& request);

}  // namespace pcrb_tools
