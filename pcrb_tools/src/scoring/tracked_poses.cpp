#include "scoring/tracked_poses.hpp"

#include <filesystem>
#include <map>
#include <utility>

#include "archives/pose_messages.hpp"
#include "archives/transform_tree.hpp"
#include "pcrb_core/datasets/pose_file.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_server/message_conversion.hpp"

namespace pcrb_tools {
namespace {

/// The stamp of a scan by its number or name.
class ScanStamps {
 public:
  explicit ScanStamps(const pcrb::ScanList& list) {
    for (const auto& [stamp, name] : list.scans) {
      stamps_.push_back(stamp);
      by_stem_[stemOf(name)] = stamp;
    }
  }

  pcrb::Stamp of(const pcrb::FilePose& pose, pcrb::PoseKey key, const std::string& path) const {
    if (key == pcrb::PoseKey::kStamp) return pose.stamp;
    if (key == pcrb::PoseKey::kIndex) {
      if (pose.index < stamps_.size()) return stamps_[pose.index];
      throw pcrb::InvalidFile(
          path, 0, "a pose of scan " + std::to_string(pose.index),
          "0 to " + std::to_string(stamps_.size() - 1) + ", as there are no timestamps");
    }
    const auto found = by_stem_.find(stemOf(pose.name));
    if (found != by_stem_.end()) return found->second;
    throw pcrb::InvalidFile(path, 0, "a pose of `" + pose.name + "`", "the file of a scan");
  }

 private:
  static std::string stemOf(const std::string& name) {
    return std::filesystem::path(name).stem().string();
  }

  std::vector<pcrb::Stamp> stamps_;
  std::map<std::string, pcrb::Stamp> by_stem_;
};

pcrb::Trajectory trajectoryOfText(const PoseSource& source, const pcrb::ScanList& list,
                                  std::vector<std::string>& notes) {
  const std::string& path = source.path;
  const pcrb::PoseFile file =
      pcrb::parsePoseFile(pcrb::FileBytes(path).text(), path, source.format);
  notes.insert(notes.end(), file.notes.begin(), file.notes.end());
  const ScanStamps stamps(list);
  std::vector<pcrb::StampedPose> poses;
  for (const pcrb::FilePose& pose : file.poses) {
    poses.push_back({stamps.of(pose, file.key, path), pose.T_world_body});
  }
  return pcrb::Trajectory(std::move(poses));
}

pcrb::Trajectory trajectoryOfTf(const BagMessages& bag, const std::vector<std::string>& frames) {
  const TransformTree tree(bag);
  std::vector<pcrb::StampedPose> poses;
  for (const pcrb::Stamp stamp : tree.stampsBetween(frames[0], frames[1])) {
    const auto pose = tree.lookup(frames[0], frames[1], stamp, pcrb::kSecond);
    if (pose.status == pcrb::PoseStatus::kFound) poses.push_back({stamp, pose.T_world_body});
  }
  if (poses.empty()) {
    throw pcrb::InvalidFile(
        "tf", 0,
        "no motion between `" + frames[0] + "` and `" + frames[1] + "` among " + tree.describe(),
        "tf of what was tracked");
  }
  return pcrb::Trajectory(std::move(poses));
}

pcrb::Trajectory trajectoryOfBag(const TrackingOptions& options) {
  const PoseSource& source = options.poses;
  const BagMessages bag({source.path});
  if (!options.tf.empty()) return trajectoryOfTf(bag, options.tf);
  if (source.topic.empty()) {
    throw pcrb::InvalidParameter(
        "found neither --topic nor --tf, expected where the poses are in " + source.path + ": " +
        bag.describeTopics());
  }
  BagTrajectory found = readBagTrajectory(bag, source.topic);
  if (found.world_frame != pcrb::withoutSlash(source.map_frame)) {
    throw pcrb::InvalidFile(source.path + ", " + source.topic, 0,
                            "a pose in the frame `" + found.world_frame + "`",
                            "`" + source.map_frame + "`");
  }
  return std::move(found.trajectory);
}

}  // namespace

pcrb::Trajectory readTrackedPoses(const TrackingOptions& options, const pcrb::ScanList& list,
                                  std::vector<std::string>& notes) {
  pcrb::Trajectory trajectory = isBag(options.poses.path)
                                    ? trajectoryOfBag(options)
                                    : trajectoryOfText(options.poses, list, notes);
  if (trajectory.duplicates() > 0) {
    notes.push_back(std::to_string(trajectory.duplicates()) +
                    " poses have the stamp of a later one, or its scan, and were not used");
  }
  return trajectory;
}

}  // namespace pcrb_tools
