#pragma once

#include <sensor_msgs/PointCloud2.h>

#include <string>

#include "conversion/kaist_gate.hpp"
#include "pcrb_core/datasets/scan_pairer.hpp"

namespace pcrb_tools {

/// Makes clouds of two streams of messages, from a bag or live.
class KaistStream {
 public:
  using Message = sensor_msgs::PointCloud2::ConstPtr;

  /// Frames, request and conversion must outlive it and its clouds.
  /// @param identity  of the streams, for fingerprints
  KaistStream(const KaistFrames& frames, const KaistRequest& request, const std::string& sequence,
              const std::string& identity, Conversion& conversion);

  void addLeft(const Message& message);
  void addRight(const Message& message);

  /// Converts what still waits for a partner.
  void finish();

 private:
  using Pairer = pcrb::ScanPairer<Message>;

  void convert(const std::vector<Pairer::Pair>& pairs);

  const KaistFrames& frames_;
  const KaistRequest& request_;
  std::string identity_;
  Conversion& conversion_;
  KaistGate gate_;
  Pairer pairer_;
};

}  // namespace pcrb_tools
