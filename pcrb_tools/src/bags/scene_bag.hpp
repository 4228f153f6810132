#pragma once

#include <string>

#include "archives/atomic_bag.hpp"
#include "pcrb_server/playback/scene.hpp"

namespace pcrb_tools {

/// A bag of scenes that `rosbag play` replays: every message under the topic that `replay`
/// publishes it on, latched where that is (connection header `latching=1`). It appears complete or
/// not at all; the same scenes give the same bytes.
class SceneBag {
 public:
  /// @throws pcrb::InvalidFile  if the bag cannot be written.
  SceneBag(const std::string& path, bool compress);

  /// At the scene's stamp.
  void write(const pcrb::Scene& scene);

  /// Checks that the disk has all of it, and gives the bag its name. Call once, last.
  void commit() { bag_.commit(); }

 private:
  AtomicBag bag_;
};

}  // namespace pcrb_tools
