#pragma once

#include <optional>
#include <set>
#include <string>

#include "conversion/tum_conversion.hpp"
#include "pcrb_core/datasets/stamp.hpp"
#include "pcrb_core/datasets/tum.hpp"

namespace pcrb_tools {

/// Decides which clouds of a TUM log are converted, and with which pose: the same for bags, PNGs
/// and live topics.
class TumGate {
 public:
  /// All but the number must outlive it.
  /// @param max_rate  Hz; 0 = all
  TumGate(const pcrb::Trajectory& trajectory, const TumOptions& options, double max_rate,
          Conversion& conversion);

  /// The pose of a cloud that is to be converted; else it is dropped from the conversion with the
  /// reason. Only clouds with a pose count against the rate.
  std::optional<pcrb::Transform> admit(pcrb::Stamp stamp);

  /// A cloud's file name: `1311878220.377686160.pcd`.
  static std::string cloudName(pcrb::Stamp stamp) { return pcrb::formatStamp(stamp) + ".pcd"; }

 private:
  pcrb::PoseLookup poseAt(pcrb::Stamp stamp) const;

  const pcrb::Trajectory& trajectory_;
  const TumOptions& options_;
  Conversion& conversion_;
  pcrb::RateLimiter limiter_;
  pcrb::StreamClock clock_;
  std::set<pcrb::Stamp> admitted_;
};

/// Notes what a user should know of the poses.
void noteTrajectory(const pcrb::Trajectory& trajectory, Conversion& conversion);

/// Camera and units for fingerprints.
std::string cameraText(const pcrb::Intrinsics& intrinsics, double units_per_metre);

/// The part of convertTum for bags.
ConversionReport convertTumBags(const TumRequest& request);

}  // namespace pcrb_tools
