#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "pcrb_core/point_cloud.hpp"
#include "pcrb_core/run/problem_poser.hpp"
#include "pcrb_core/search/voxel_map.hpp"
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

  const std::string& map() const { return map_frame_; }

 private:
  std::string map_frame_;
  bool is_earth_known_ = false;
};

/// What scenes of problems and of results have in common: the target, and the source as perturbed,
/// with tf.
///
/// @param source_frame  frame that the source is perturbed in.
/// @param show_target   false where the scene before has shown it.
Scene problemScene(const PosedProblem& posed, const ros::Time& stamp, bool show_target,
                   const std::string& source_frame, SceneFrames& frames);

/// Rows of what is known of a problem before anybody has answered it.
std::string captionOf(const PosedProblem& posed);

bool contains(const std::vector<std::string>& words, const std::string& word);

/// Adds a text above where T_map_source puts the source's centroid.
void addText(Scene& scene, const PosedProblem& posed, const Transform& T_map_source,
             const std::string& text, const std::string& map_frame);

/// A voxelised map that grows by clouds but not beyond a number of points: whenever there are more,
/// voxels become twice as long.
class BoundedMap {
 public:
  /// @param leaf    edge of a voxel at first, m, > 0.
  /// @param limit   points, > 0.
  /// @throws InvalidParameter  if either is not so.
  BoundedMap(double leaf, std::size_t limit);

  /// @throws InvalidProblem  as VoxelMap.
  void add(const DatasetCloud& cloud);

  DatasetCloud cloud() const { return map_.cloud(); }
  std::size_t size() const { return map_.size(); }
  double leaf() const { return leaf_; }  ///< m

 private:
  double leaf_;
  std::size_t limit_;
  VoxelMap map_;
};

}  // namespace pcrb
