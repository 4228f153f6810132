#include <sensor_msgs/PointCloud2.h>

#include <utility>

#include "archives/bag_messages.hpp"
#include "archives/pose_messages.hpp"
#include "archives/transform_tree.hpp"
#include "conversion/own_log.hpp"
#include "conversion/raw_scans.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/text.hpp"
#include "pcrb_server/message_conversion.hpp"

namespace pcrb_tools {
namespace {

constexpr const char* kCloudType = "sensor_msgs/PointCloud2";

/// The clouds of bags, and what places them.
class OwnBag {
 public:
  explicit OwnBag(const OwnRequest& request)
      : request_(request),
        bags_(request.inputs),
        tree_(bags_),
        topic_(chooseCloudTopic()),
        cloud_frame_(frameOfClouds()) {}

  ConversionReport convert() {
    Placement placement = findPlacement();
    Conversion conversion(request_, sequenceOf(request_), bags_.count({topic_}));
    for (const std::string& note : notes_) conversion.note(note);
    OwnScans scans(request_, placement, bags_.identity() + topic_, conversion);
    bags_.forEach({topic_}, [&](const rosbag::MessageInstance& instance) {
      add(messageAs<sensor_msgs::PointCloud2>(instance), scans);
    });
    return conversion.finish();
  }

 private:
  std::string chooseCloudTopic() const {
    if (!request_.cloud_topic.empty()) {
      if (bags_.count({request_.cloud_topic}) > 0) return request_.cloud_topic;
      throw pcrb::InvalidFile(
          request_.inputs.front(), 0,
          "no message on " + request_.cloud_topic + " among " + bags_.describeTopics(),
          "clouds (--cloud-topic)");
    }
    std::vector<std::string> found;
    for (const auto& [topic, type] : bags_.topics()) {
      if (type == kCloudType) found.push_back(topic);
    }
    if (found.size() == 1) return found.front();
    throw pcrb::InvalidFile(request_.inputs.front(), 0,
                            found.empty() ? "no cloud among " + bags_.describeTopics()
                                          : "clouds on " + pcrb::joined(found),
                            std::string(found.empty() ? "a topic" : "one topic") + " of " +
                                kCloudType + " (--cloud-topic chooses)");
  }

  /// Of the first cloud; the others are held against it.
  std::string frameOfClouds() const {
    std::string frame;
    bool is_first = true;
    bags_.forEach({topic_}, [&](const rosbag::MessageInstance& instance) {
      if (!std::exchange(is_first, false)) return;
      frame = pcrb::withoutSlash(messageAs<sensor_msgs::PointCloud2>(instance)->header.frame_id);
    });
    return frame;
  }

  Placement findPlacement() {
    if (!request_.poses.empty()) return byFile();
    if (!request_.tf.empty()) return byTf(request_.tf[0], request_.tf[1]);
    if (!request_.pose_topic.empty()) return byTopic(request_.pose_topic);
    const bool is_on_tf = !cloud_frame_.empty() && tree_.has(cloud_frame_) &&
                          tree_.isMoving(tree_.rootOf(cloud_frame_), cloud_frame_);
    const std::vector<std::string> topics = poseTopics();
    if (topics.size() + (is_on_tf ? 1 : 0) == 1) {
      return is_on_tf ? byTf(tree_.rootOf(cloud_frame_), cloud_frame_) : byTopic(topics.front());
    }
    std::vector<std::string> found = topics;
    if (is_on_tf) found.push_back("tf of " + tree_.rootOf(cloud_frame_) + " > " + cloud_frame_);
    throw pcrb::InvalidFile(
        request_.inputs.front(), 0,
        found.empty() ? "no poses of the clouds' frame `" + cloud_frame_ + "` among " +
                            bags_.describeTopics() + "; " + tree_.describe()
                      : "poses on " + pcrb::joined(found),
        "one source of poses (--topic, --tf WORLD BODY or --poses FILE chooses)");
  }

  /// Topics that can be a trajectory; paths, which repeat their poses, only if there is no other.
  std::vector<std::string> poseTopics() const {
    std::vector<std::string> topics;
    std::vector<std::string> paths;
    for (const auto& [topic, type] : bags_.topics()) {
      if (type == "nav_msgs/Path") {
        paths.push_back(topic);
      } else if (isPoseType(type) && bags_.count({topic}) > 1) {
        topics.push_back(topic);
      }
    }
    return topics.empty() ? paths : topics;
  }

  Placement byFile() {
    const pcrb::FileBytes bytes(request_.poses);
    const auto [trajectory, notes] =
        pcrb::parseTrajectory(bytes.text(), request_.poses, request_.pose_format);
    notes_.insert(notes_.end(), notes.begin(), notes.end());
    return complete(placementBy(trajectory, request_), "", "");
  }

  Placement byTopic(const std::string& topic) {
    BagTrajectory poses = readBagTrajectory(bags_, topic);
    notes_.push_back("poses: " + topic + ", in the frame `" + poses.world_frame + "`");
    return complete(placementBy(poses.trajectory, request_), poses.world_frame, poses.body_frame);
  }

  Placement byTf(const std::string& world, const std::string& body) {
    notes_.push_back("poses: tf of " + world + " > " + body);
    std::vector<pcrb::Stamp> stamps = tree_.stampsBetween(world, body);
    if (stamps.empty()) {
      throw pcrb::InvalidFile(
          request_.inputs.front(), 0,
          "no motion between `" + world + "` and `" + body + "` among " + tree_.describe(),
          "tf of a body that moves");
    }
    const auto poses = [this, world, body](pcrb::Stamp stamp) {
      return tree_.lookup(world, body, stamp, request_.max_gap);
    };
    return complete(placementBy(poses, std::move(stamps), request_), world, body);
  }

  /// Finds what lies between body and sensor, and between the poses' world and the wanted one.
  Placement complete(Placement placement, const std::string& world, const std::string& named_body) {
    const std::string body = request_.body_frame.empty() ? named_body : request_.body_frame;
    if (!world.empty() && cloud_frame_ == world) {
      if (request_.deskew) {
        throw pcrb::InvalidParameter("--deskew: found clouds in the frame `" + world +
                                     "` of the poses, expected them in their sensor's");
      }
      placement.in_world = true;
      notes_.push_back("the clouds are in the frame `" + world + "` of the poses");
    } else if (!placement.in_world) {
      placement.T_body_sensor = sensorInBody(body);
    }
    const std::string& wanted = request_.world_frame;
    if (wanted.empty() || wanted == world) return placement;
    if (world.empty()) {
      throw pcrb::InvalidParameter(
          "--world-frame: found poses without a frame, expected those of "
          "a topic or of tf");
    }
    tree_.lookup(wanted, world, 0, request_.max_gap);  // connected
    placement.world = [this, wanted, world](pcrb::Stamp stamp) {
      return tree_.lookup(wanted, world, stamp, request_.max_gap);
    };
    return placement;
  }

  pcrb::Transform sensorInBody(const std::string& body) {
    if (request_.T_body_sensor) return *request_.T_body_sensor;
    if (body.empty()) {
      notes_.push_back("the poses name no frame that they are of: they were taken as those of `" +
                       cloud_frame_ + "` (--body-frame or --sensor-in-body say otherwise)");
      return pcrb::Transform::Identity();
    }
    if (body == cloud_frame_) return pcrb::Transform::Identity();
    if (!tree_.has(body) || !tree_.has(cloud_frame_) ||
        tree_.rootOf(body) != tree_.rootOf(cloud_frame_) || tree_.isMoving(body, cloud_frame_)) {
      throw pcrb::InvalidFile(request_.inputs.front(), 0,
                              "no fixed transform from the clouds' frame `" + cloud_frame_ +
                                  "` to that of the poses, `" + body + "`, among " +
                                  tree_.describe(),
                              "it on tf, or --sensor-in-body x y z qx qy qz qw");
    }
    notes_.push_back("extrinsics: tf of " + body + " > " + cloud_frame_);
    return tree_.lookup(body, cloud_frame_, 0, request_.max_gap).T_world_body;
  }

  void add(const sensor_msgs::PointCloud2::ConstPtr& cloud, OwnScans& scans) const {
    const pcrb::Stamp stamp = pcrb::stampOf(cloud->header.stamp);
    const std::string frame = pcrb::withoutSlash(cloud->header.frame_id);
    const std::string name = pcrb::formatStamp(stamp) + ".pcd";
    if (frame != cloud_frame_) {
      throw pcrb::InvalidFile("topic " + topic_ + " " + name, 0, "the frame `" + frame + "`",
                              "`" + cloud_frame_ + "`, as of the clouds before");
    }
    const bool needs_times = request_.deskew;
    const auto read = [cloud, needs_times, origin = request_.files.origin,
                       label = topic_ + " " + name] {
      return needs_times ? timedScanOf(*cloud, origin, label) : scanOf(*cloud, origin, label);
    };
    scans.add({name, stamp, read});
  }

  const OwnRequest& request_;
  BagMessages bags_;
  TransformTree tree_;
  std::string topic_;
  std::string cloud_frame_;
  std::vector<std::string> notes_;
};

}  // namespace

ConversionReport convertOwnBags(const OwnRequest& request) { return OwnBag(request).convert(); }

}  // namespace pcrb_tools
