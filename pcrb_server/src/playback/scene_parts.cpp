#include "playback/scene_parts.hpp"

#include <algorithm>
#include <sstream>

#include "pcrb_core/error.hpp"
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

Scene problemScene(const PosedProblem& posed, const ros::Time& stamp, bool show_target,
                   const std::string& source_frame, SceneFrames& frames) {
  Scene scene;
  scene.name = posed.planned->key.problem_id;
  frames.set(scene, stamp, posed.target->cloud);
  if (show_target) {
    scene.clouds.emplace_back(topics::kTarget, toMessage(posed.target->cloud, Transform::Identity(),
                                                         makeHeader(frames.map(), stamp)));
  }
  scene.clouds.emplace_back(
      topics::kSource,
      toMessage(posed.source->cloud, posed.presentation.applied, makeHeader(source_frame, stamp)));
  return scene;
}

std::string captionOf(const PosedProblem& posed) {
  const ProblemKey& key = posed.planned->key;
  std::ostringstream text;
  text.precision(3);
  text << "problem: " << key.problem_id << "\nsequence: " << key.data_set << "/" << key.sequence
       << "\nkind: " << toString(key.kind) << "\nsource: " << posed.planned->problem.source
       << "\ntarget: " << posed.planned->problem.target
       << "\noverlap: " << posed.planned->problem.overlap << "\ninitial: " << posed.initial.error
       << "\n";
  return text.str();
}

bool contains(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

void addText(Scene& scene, const PosedProblem& posed, const Transform& T_map_source,
             const std::string& text, const std::string& map_frame) {
  scene.markers.emplace();
  scene.markers->markers.push_back(textMarker(
      makeHeader(map_frame, scene.stamp), T_map_source * posed.source->metric->centroid(), text));
}

BoundedMap::BoundedMap(double leaf, std::size_t limit) : leaf_(leaf), limit_(limit), map_(leaf) {
  if (limit == 0) throw InvalidParameter("map: found a limit of 0 points, expected 1 or more");
}

void BoundedMap::add(const DatasetCloud& cloud) {
  map_.add(cloud);
  while (map_.size() > limit_) {
    leaf_ *= 2.0;
    VoxelMap coarser(leaf_);
    coarser.add(map_.cloud());
    map_ = std::move(coarser);
  }
}

}  // namespace pcrb
