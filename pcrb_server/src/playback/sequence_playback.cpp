#include <algorithm>
#include <filesystem>
#include <optional>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/problem/dataset.hpp"
#include "pcrb_server/message_conversion.hpp"
#include "pcrb_server/playback/playback.hpp"
#include "playback/scene_parts.hpp"

namespace pcrb {

namespace {

namespace fs = std::filesystem;

constexpr const char* kSensorFrame = "pcrb_sensor";
constexpr double kPositionDeviation = 0.5;  // m, of the initial pose, as localization_bridge's
constexpr double kAngleDeviation = 0.26;    // rad

/// Absolute, without a slash at the end.
fs::path pathOf(const SequenceOptions& options) {
  return fs::absolute(options.folder + "/").lexically_normal().parent_path();
}

double leafOf(const SequenceOptions& options) {
  if (options.map_leaf > 0.0) return options.map_leaf;
  const fs::path data_set = pathOf(options).parent_path();
  return loadDataset(data_set.parent_path(), data_set.filename()).voxel_leaf;
}

class SequencePlayback : public Playback {
 public:
  explicit SequencePlayback(const SequenceOptions& options)
      : options_(options),
        names_(scansOf(options)),
        leaf_(leafOf(options)),
        frames_(options.map_frame),
        growing_(leaf_, options.map_points) {
    const DatasetCloud first = read(0);
    if (options.map_file.empty()) {
      local_origin_ = chooseLocalOrigin(first);
    } else {
      const DatasetCloud map = readPcd(options.map_file);
      local_origin_ = chooseLocalOrigin(map);
      map_ = makeLocal(map, local_origin_);
    }
    if (!options.publish_ground_truth) requireViewpoint(first, 0);
  }

  std::size_t size() const override { return names_.size(); }

  double lead() const override {
    const bool is_first = position_ == 0 || position_ == names_.size();
    const bool is_for_node = !options_.publish_ground_truth;
    return is_first && is_for_node ? options_.map_settle + options_.initialpose_settle : 0.0;
  }

  Scene next(const ros::Time& stamp) override {
    if (position_ == names_.size()) position_ = 0;
    if (position_ == 0) start();
    const DatasetCloud read_cloud = read(position_);
    Scene scene;
    scene.name = names_[position_];
    scene.title = pathOf(options_).filename().string() + " " + scene.name;
    scene.caption = "sequence: " + pathOf(options_).filename().string() + "\nscan: " + scene.name +
                    "\nnumber: " + std::to_string(position_ + 1) + " of " +
                    std::to_string(names_.size()) + "\n";
    std::optional<Transform> sensor;  // T_map_sensor, where it is known
    if (read_cloud.hasViewpoint()) {
      sensor = inMap(read_cloud.viewpoint);
    } else {
      scene.title += " (no VIEWPOINT: where the sensor was is not known)";
    }
    if (options_.publish_ground_truth) {
      showTruth(scene, stamp, read_cloud, sensor);
    } else {
      requireViewpoint(read_cloud, position_);
      showToNode(scene, stamp, read_cloud, *sensor);
    }
    ++position_;
    return scene;
  }

  /// The map and the path, where there are any, grow anew up to there.
  void seek(std::size_t position) override {
    position_ = options_.publish_ground_truth ? 0 : position;
    while (position_ < position) next(ros::Time(0, 1));
  }

 private:
  DatasetCloud read(std::size_t position) const {
    return readPcd(options_.folder + "/" + names_[position]);
  }

  void requireViewpoint(const DatasetCloud& cloud, std::size_t position) const {
    if (cloud.hasViewpoint()) return;
    throw InvalidFile(options_.folder + "/" + names_[position], 0, "no VIEWPOINT",
                      "the sensor's pose, without which a scan cannot be shown in its own frame");
  }

  Transform inMap(const Transform& T_dataset_sensor) const {
    Transform T = T_dataset_sensor;
    T.translation() -= local_origin_;
    return T;
  }

  void start() {
    growing_ = BoundedMap(leaf_, options_.map_points);
    path_.poses.clear();
  }

  /// The scan where it belongs, the map as it has grown, the sensor's way.
  void showTruth(Scene& scene, const ros::Time& stamp, const DatasetCloud& read_cloud,
                 const std::optional<Transform>& sensor) {
    const std_msgs::Header header = makeHeader(options_.map_frame, stamp);
    const PointCloud scan = makeLocal(read_cloud, local_origin_);
    if (options_.map_file.empty()) {
      growing_.add(read_cloud);
      map_ = makeLocal(growing_.cloud(), local_origin_);
    }
    frames_.set(scene, stamp, map_);
    scene.clouds.emplace_back(topics::kScan, toMessage(scan, Transform::Identity(), header));
    if (options_.map_file.empty() || position_ == 0) {
      scene.clouds.emplace_back(topics::kMap, toMessage(map_, Transform::Identity(), header));
    }
    if (!sensor) return;
    scene.sensor.emplace();
    scene.sensor->header = header;
    scene.sensor->pose = toMessage(*sensor);
    scene.transforms.transforms.push_back(toMessage(*sensor, header, kSensorFrame));
    path_.header = header;
    path_.poses.push_back(*scene.sensor);
    scene.path = path_;
  }

  /// What a node under test gets.
  void showToNode(Scene& scene, const ros::Time& stamp, const DatasetCloud& read_cloud,
                  const Transform& sensor) {
    PointCloud origin_only;
    origin_only.local_origin = local_origin_;
    frames_.set(scene, stamp, options_.map_file.empty() ? origin_only : map_);
    if (!options_.base_frame.empty()) {
      scene.static_transforms.transforms.push_back(toMessage(
          Transform::Identity(), makeHeader(options_.base_frame, stamp), options_.scan_frame));
    }
    if (position_ == 0) showStart(scene, sensor);
    scene.clouds.emplace_back(topics::kScan,
                              toMessage(withIntensity(makeLocal(read_cloud, local_origin_)),
                                        sensor.inverse(), makeHeader(options_.scan_frame, stamp)));
  }

  /// The map and the initial pose, each before the first scan.
  void showStart(Scene& scene, const Transform& sensor) const {
    scene.initial_pose_lead = options_.initialpose_settle;
    scene.map_lead = options_.map_settle + options_.initialpose_settle;
    scene.initial_pose.emplace();
    scene.initial_pose->header = makeHeader(options_.map_frame, scene.dueAt(topics::kInitialPose));
    scene.initial_pose->pose.pose = toMessage(sensor);
    const auto covariance = planarCovariance(kPositionDeviation, kAngleDeviation);
    std::copy(covariance.begin(), covariance.end(), scene.initial_pose->pose.covariance.begin());
    if (options_.map_file.empty()) return;
    scene.clouds.emplace_back(topics::kMap,
                              toMessage(withIntensity(map_), Transform::Identity(),
                                        makeHeader(options_.map_frame, scene.dueAt(topics::kMap))));
  }

  SequenceOptions options_;
  std::vector<std::string> names_;
  double leaf_;
  SceneFrames frames_;
  Eigen::Vector3d local_origin_;
  BoundedMap growing_;
  PointCloud map_;
  nav_msgs::Path path_;
  std::size_t position_ = 0;
};

}  // namespace

std::vector<std::string> scansOf(const SequenceOptions& options) {
  std::vector<std::string> names = findClouds(options.folder);
  const auto remove = [&names](const std::string& name) {
    const auto end = std::remove(names.begin(), names.end(), name);
    const bool was_there = end != names.end();
    names.erase(end, names.end());
    return was_there;
  };
  for (const std::string& name : options.excluded) {
    if (remove(name)) continue;
    throw InvalidParameter("found no cloud `" + name + "` in " + options.folder +
                           ", expected the name of one of its .pcd files");
  }
  if (!options.map_file.empty()) {
    const fs::path map = fs::absolute(options.map_file).lexically_normal();
    if (map.parent_path() == pathOf(options)) remove(map.filename());
  }
  if (names.empty()) throw InvalidFile(options.folder, 0, "no scan", "a sequence's .pcd files");
  return names;
}

std::unique_ptr<Playback> playSequence(const SequenceOptions& options) {
  return std::make_unique<SequencePlayback>(options);
}

}  // namespace pcrb
