#include "playback/scene_frames.hpp"

#include "pcrb_server/message_conversion.hpp"
#include "ros/drawing.hpp"

namespace pcrb {

void SceneFrames::set(Scene& scene, const ros::Time& stamp, const PointCloud& shown) {
  scene.stamp = stamp;
  scene.local_origin = shown.local_origin;
  is_earth_known_ |= !shown.local_origin.isZero();
  auto& transforms = scene.static_transforms.transforms;
  if (is_earth_known_) {
    transforms.push_back(toMessage(Transform(Eigen::Translation3d(shown.local_origin)),
                                   makeHeader("earth", stamp), map_frame_));
  }
  transforms.push_back(toMessage(Transform(Eigen::Translation3d(boxCenter(shown))),
                                 makeHeader(map_frame_, stamp), "pcrb_target"));
}

}  // namespace pcrb
