#pragma once

#include <cstdint>
#include <string>

#include "archives/atomic_bag.hpp"
#include "simulation/depth_camera.hpp"

namespace pcrb_tools::simulation {

/// A bag as the data set's recorder writes it; it appears when it is committed.
class TumBag {
 public:
  TumBag(const std::string& path, const DepthCamera& camera);

  /// What `…-2hz-with-pointclouds.bag` has: organized clouds, with and at times without colour.
  void writeClouds(const RgbdFrame& frame, std::int64_t stamp_ns, int sequence_number);

  /// What the raw bag has: depth in m, colour, and the intrinsics of both.
  void writeImages(const RgbdFrame& frame, std::int64_t stamp_ns, int sequence_number);

  /// Closes the bag and gives it its name. Call once, last.
  /// @throws InvalidFile  if the disk does not take it; so do the writing functions.
  void commit() { bag_.commit(); }

 private:
  template <typename Message>
  void write(const std::string& topic, const Message& message);

  DepthCamera camera_;
  AtomicBag bag_;
};

}  // namespace pcrb_tools::simulation
