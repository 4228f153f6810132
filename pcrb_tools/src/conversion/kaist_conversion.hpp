#pragma once

#include <string>

#include "conversion/conversion.hpp"
#include "pcrb_core/datasets/kaist.hpp"

namespace pcrb_tools {

struct KaistRequest : ConversionRequest {
  KaistRequest() { data_set = "kaist"; }

  std::string poses;              ///< global_pose.csv; empty: from the log
  std::string left_calibration;   ///< Vehicle2LeftVLP.txt; empty: from the log
  std::string right_calibration;  ///< Vehicle2RightVLP.txt; empty: from the log
  pcrb::KaistOptions options;
  pcrb::OriginPoints origin = pcrb::OriginPoints::kDrop;
  double max_rate = 0.0;  ///< Hz; 0 = all scans
  std::string left_topic = "/ns1/velodyne_points";
  std::string right_topic = "/ns2/velodyne_points";
};

/// Converts a KAIST urban sequence: its log (folders and archives with sensor_data, calibration and
/// global_pose.csv), or bags of the two velodyne topics together with the poses and calibration.
///
/// A cloud is a left scan and the right scan closest in time, each moved by its own pose; scans
/// without a pose or a partner are dropped and reported.
/// @throws InvalidFile  for defects of the log; what was complete before stays.
/// @throws InvalidParameter  if the sequence is not given and not in the names.
ConversionReport convertKaist(const KaistRequest& request);

}  // namespace pcrb_tools
