#pragma once

#include <rosbag/bag.h>

#include <cstdint>
#include <functional>
#include <string>

#include "simulation/depth_camera.hpp"

namespace pcrb_tools::simulation {

/// A bag as the data set's recorder writes it; it appears when it is committed.
class TumBag {
 public:
  TumBag(const std::string& output, const std::string& file, const DepthCamera& camera);
  ~TumBag();
  TumBag(const TumBag&) = delete;
  TumBag& operator=(const TumBag&) = delete;

  /// What `…-2hz-with-pointclouds.bag` has: organized clouds, with and at times without colour.
  void writeClouds(const RgbdFrame& frame, std::int64_t stamp_ns, int sequence_number);

  /// What the raw bag has: depth in m, colour, and the intrinsics of both.
  void writeImages(const RgbdFrame& frame, std::int64_t stamp_ns, int sequence_number);

  /// Closes the bag and gives it its name. Call once, last.
  /// @throws InvalidFile  if the disk does not take it; so do the writing functions.
  void commit();

 private:
  /// Calls an action and turns what rosbag throws into an error that names the file.
  void guarded(const std::function<void()>& action);
  template <typename Message>
  void write(const std::string& topic, const Message& message);

  DepthCamera camera_;
  std::string path_;
  std::string temporary_path_;
  rosbag::Bag bag_;
};

}  // namespace pcrb_tools::simulation
