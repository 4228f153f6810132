#include "playback/problem_scene.hpp"

#include "pcrb_server/message_conversion.hpp"
#include "ros/drawing.hpp"

namespace pcrb {

Scene problemScene(const PosedProblem& posed, const ros::Time& stamp, bool show_target,
                   SceneFrames& frames, const ServerParameters& parameters) {
  Scene scene;
  scene.name = posed.planned->key.problem_id;
  frames.set(scene, stamp, posed.target->cloud);
  if (show_target) {
    scene.clouds.emplace_back(topics::kTarget, toMessage(posed.target->cloud, Transform::Identity(),
                                                         makeHeader(parameters.map_frame, stamp)));
  }
  scene.clouds.emplace_back(topics::kSource,
                            toMessage(posed.source->cloud, posed.presentation.applied,
                                      makeHeader(parameters.sourceFrame(), stamp)));
  return scene;
}

void addText(Scene& scene, const PosedProblem& posed, const Transform& T_map_source,
             const std::string& text, const std::string& map_frame) {
  scene.markers.emplace();
  scene.markers->markers.push_back(textMarker(
      makeHeader(map_frame, scene.stamp), T_map_source * posed.source->metric->centroid(), text));
}

}  // namespace pcrb
