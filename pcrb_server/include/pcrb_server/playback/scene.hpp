#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/Path.h>
#include <pcrb_msgs/Problem.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_msgs/TFMessage.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pcrb_core/datasets/stamp.hpp"
#include "pcrb_server/topics.hpp"

namespace pcrb {

/// All messages of one moment of a replay: what `replay` publishes and the bag tools write.
struct Scene {
  std::string title;    ///< for people: which scan or problem this is
  std::string name;     ///< file name of the scan, or official id of the problem
  std::string caption;  ///< for people: what is known of it, rows `name: value`
  ros::Time stamp;      ///< of every message but static transforms, which hold for all times
  Eigen::Vector3d local_origin = Eigen::Vector3d::Zero();  ///< m: p_dataset = p_map + local_origin

  tf2_msgs::TFMessage transforms;
  tf2_msgs::TFMessage static_transforms;  ///< all there are: the last message is what is latched
  std::optional<pcrb_msgs::Problem> problem;
  std::optional<geometry_msgs::PoseWithCovarianceStamped> initial_pose;
  std::vector<std::pair<const char*, sensor_msgs::PointCloud2>> clouds;  ///< by topic
  std::optional<geometry_msgs::PoseStamped> sensor;
  std::optional<nav_msgs::Path> path;
  std::optional<visualization_msgs::MarkerArray> markers;

  /// s before the stamp at which map and static transforms, and the initial pose, are due: a node
  /// needs time for them before the first scan.
  double map_lead = 0.0;
  double initial_pose_lead = 0.0;

  /// When the messages of a topic are due.
  ros::Time dueAt(const std::string& topic) const {
    const bool is_early = topic == topics::kMap || topic == topics::kTfStatic;
    const double lead = is_early                        ? map_lead
                        : topic == topics::kInitialPose ? initial_pose_lead
                                                        : 0.0;
    return stamp - ros::Duration(lead);
  }
};

/// Calls `take(topic, message, is_latched)` with each message, those first without which others
/// cannot be shown. Topics that begin with a slash are in no namespace.
template <typename Take>
void forEachMessage(const Scene& scene, const Take& take) {
  if (!scene.static_transforms.transforms.empty()) {
    take(topics::kTfStatic, scene.static_transforms, true);
  }
  if (!scene.transforms.transforms.empty()) take(topics::kTf, scene.transforms, false);
  if (scene.problem) take(topics::kProblem, *scene.problem, true);
  if (scene.initial_pose) take(topics::kInitialPose, *scene.initial_pose, true);
  for (const auto& [topic, cloud] : scene.clouds) take(topic, cloud, true);
  if (scene.sensor) take(topics::kSensor, *scene.sensor, true);
  if (scene.path) take(topics::kPath, *scene.path, true);
  if (scene.markers) take(topics::kMarkers, *scene.markers, true);
}

/// Which scan was published when, and in which frame: what score_poses needs to score a node's
/// trajectory. A text of rows `timestamp file`, as TUM's lists of images, below a comment with the
/// local origin.
struct ScanList {
  Eigen::Vector3d local_origin = Eigen::Vector3d::Zero();  ///< m: p_dataset = p_map + local_origin
  std::map<Stamp, std::string> scans;                      ///< file names
};

/// Appends a scene's row; for an empty text first the header.
void appendScan(std::string& text, const Scene& scene);

/// @throws InvalidFile  with line, what was found and what was expected.
ScanList readScanList(const std::string& path);

}  // namespace pcrb
