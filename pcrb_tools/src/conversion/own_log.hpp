#pragma once

#include <functional>
#include <set>
#include <string>

#include "conversion/conversion.hpp"
#include "conversion/own_request.hpp"
#include "conversion/placement.hpp"

namespace pcrb_tools {

/// The two kinds of logs of convertOwn().
ConversionReport convertOwnBags(const OwnRequest& request);
ConversionReport convertOwnFiles(const OwnRequest& request);

/// The sequence's name: as asked, or that of the first input without its ending.
std::string sequenceOf(const OwnRequest& request);

/// How a scan is moved and made a cloud, for every kind of log.
/// @param stamp  of the scan; used for deskewing only
/// @throws InvalidFile  if it is to be deskewed and its points have no times, or some in another
///                      unit.
ConvertedScan placeOwnScan(const OwnRequest& request, const Placement& placement,
                           const ScanPlace& place, pcrb::Stamp stamp, pcrb::SensorScan scan,
                           const std::string& name);

/// @throws InvalidFile  if the request asks for something that poses without timestamps cannot
/// give.
void requireTimestamps(const OwnRequest& request, const std::string& poses);

/// What a cloud depends on beside its scan, for fingerprints.
std::string originText(const OwnRequest& request, const Placement& placement,
                       const ScanPlace& place);

/// Takes the scans of bags in their order and makes clouds of those that are kept.
class OwnScans {
 public:
  struct Scan {
    std::string name;
    pcrb::Stamp stamp = 0;
    std::function<pcrb::SensorScan()> read;
  };

  /// All must outlive it.
  OwnScans(const OwnRequest& request, const Placement& placement, const std::string& identity,
           Conversion& conversion);

  void add(Scan scan);

 private:
  const OwnRequest& request_;
  const Placement& placement_;
  std::string identity_;
  Conversion& conversion_;
  ScanThinner thinner_;
  std::set<pcrb::Stamp> seen_;
};

}  // namespace pcrb_tools
