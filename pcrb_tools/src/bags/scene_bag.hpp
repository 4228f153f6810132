#pragma once

#include <rosbag/bag.h>

#include <memory>
#include <string>

#include "pcrb_server/playback/scene.hpp"

namespace pcrb_tools {

/// A bag of scenes that `rosbag play` replays: every message under the topic that `replay`
/// publishes it on, latched where that is (connection header `latching=1`). It appears complete or
/// not at all; the same scenes give the same bytes.
class SceneBag {
 public:
  /// @throws pcrb::InvalidFile  if the bag cannot be written.
  SceneBag(const std::string& path, bool compress);
  ~SceneBag();
  SceneBag(const SceneBag&) = delete;
  SceneBag& operator=(const SceneBag&) = delete;

  /// At the scene's stamp.
  void write(const pcrb::Scene& scene);

  /// Checks that the disk has all of it, and gives the bag its name. Call once, last.
  void commit();

 private:
  std::string path_;
  std::string temporary_path_;
  /// Leaves a bag undestroyed that cannot be closed, on a full disk: its destructor would throw and
  /// end the process.
  struct Closer {
    void operator()(rosbag::Bag* bag) const;
  };

  std::unique_ptr<rosbag::Bag, Closer> bag_;
};

}  // namespace pcrb_tools
