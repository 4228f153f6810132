#pragma once

#include <string>

#include "pcrb_core/point_cloud.hpp"
#include "pcrb_server/playback/scene.hpp"

namespace pcrb {

/// The static transforms of scenes: where the map is on the earth, where to look.
class SceneFrames {
 public:
  explicit SceneFrames(std::string map_frame) : map_frame_(std::move(map_frame)) {}

  /// Sets a scene's stamp, local origin and static transforms: `earth → map`, once a local origin
  /// was not zero, and map → pcrb_target in the middle of what is shown.
  ///
  /// @param shown  relative to its local origin, which becomes the scene's.
  void set(Scene& scene, const ros::Time& stamp, const PointCloud& shown);

 private:
  std::string map_frame_;
  bool is_earth_known_ = false;
};

}  // namespace pcrb
