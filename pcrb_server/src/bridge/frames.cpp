#include "bridge/frames.hpp"

#include <ros/this_node.h>
#include <tf2/exceptions.h>

#include <algorithm>
#include <cmath>

#include "bridge/setup_check.hpp"
#include "pcrb_server/message_conversion.hpp"

namespace pcrb {

namespace {

constexpr double kTfMemory = 60.0;  // s
constexpr std::uint32_t kTfQueue = 1000;

}  // namespace

Transform uprightFromOptical(const std::optional<Transform>& T_map_optical) {
  Eigen::Matrix3d body_optical;
  body_optical << 0, 0, 1,  //
      -1, 0, 0,             //
      0, -1, 0;
  double roll = 0.0;
  if (T_map_optical) {
    const Eigen::Matrix3d map_body = T_map_optical->linear() * body_optical.transpose();
    roll = std::atan2(map_body(2, 1), map_body(2, 2));
  }
  Transform T_upright_optical = Transform::Identity();
  T_upright_optical.linear() =
      Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()).toRotationMatrix() * body_optical;
  return T_upright_optical;
}

std::string warningOfTilt(const Transform& T_map_base) {
  constexpr double kMostOfProblems = 30.0;  // deg, by which local problems turn a sensor
  const double tilt =
      std::acos(std::clamp(T_map_base.linear()(2, 2), -1.0, 1.0)) / kRadiansPerDegree;
  if (tilt <= kMostOfProblems + 1.0) return "";
  return "warning: the IMU (imu_topic) says that the robot is level, which it is not: an initial "
         "pose tilts it by more than the 30 degrees of local problems; leave imu_topic out if the "
         "node can do without";
}

std::array<TfLinks::Link, 3> TfLinks::all() const {
  const auto& p = parameters_;
  return {{{p.tf_map_odom, "tf_map_odom", p.map_frame, p.odom_frame},
           {p.tf_odom_base, "tf_odom_base", p.odom_frame, p.base_frame, true},
           {p.tf_base_scan, "tf_base_scan", p.base_frame, p.scan_frame}}};
}

std::vector<geometry_msgs::TransformStamped> TfLinks::links(TfLink kind, const ros::Time& stamp,
                                                            const Transform& T_odom_base) const {
  std::vector<geometry_msgs::TransformStamped> links;
  for (const Link& link : all()) {
    if (link.kind != kind) continue;
    links.push_back(toMessage(link.is_moving ? T_odom_base : Transform::Identity(),
                              makeHeader(link.parent, stamp), link.child));
  }
  return links;
}

void TfLinks::sendStatic(const ros::Time& stamp) {
  const auto links = this->links(TfLink::kStatic, stamp, Transform::Identity());
  if (!links.empty()) static_.sendTransform(links);
}

void TfLinks::sendDynamic(const ros::Time& stamp, const Transform& T_odom_base) {
  const auto links = this->links(TfLink::kDynamic, stamp, T_odom_base);
  if (!links.empty()) dynamic_.sendTransform(links);
}

std::map<std::string, OwnedFrame> TfLinks::ownedChildren() const {
  std::map<std::string, OwnedFrame> children;
  for (const Link& link : all()) {
    if (link.kind == TfLink::kNone) continue;
    children.emplace(link.child,
                     OwnedFrame{link.parameter, link.parent, link.child == parameters_.scan_frame});
  }
  return children;
}

std::string adviceOn(const OwnedFrame& owned, const std::string& frame, const std::string& parent) {
  if (owned.is_scan && parent != owned.parent) {
    return "if it localizes the sensor itself, set " + howToSet("base_frame", frame) + " and " +
           howToSet("tf_odom_base", "none");
  }
  return "or set " + howToSet(owned.parameter, "none") + " if the localizer publishes " + frame +
         " itself";
}

TfWatch::TfWatch(ros::NodeHandle& node, std::map<std::string, OwnedFrame> owned, Listener listener)
    : owned_(std::move(owned)), listener_(std::move(listener)), buffer_(ros::Duration(kTfMemory)) {
  using Event = ros::MessageEvent<tf2_msgs::TFMessage const>;
  const auto no_delay = ros::TransportHints().tcpNoDelay();
  tf_ = node.subscribe<tf2_msgs::TFMessage>(
      "/tf", kTfQueue,
      boost::function<void(const Event&)>([this](const Event& event) { take(event, false); }),
      ros::VoidConstPtr(), no_delay);
  tf_static_ = node.subscribe<tf2_msgs::TFMessage>(
      "/tf_static", kTfQueue,
      boost::function<void(const Event&)>([this](const Event& event) { take(event, true); }));
}

void TfWatch::take(const ros::MessageEvent<tf2_msgs::TFMessage const>& event, bool is_static) {
  const std::string& publisher = event.getPublisherName();
  const bool is_own = publisher == ros::this_node::getName();
  std::vector<geometry_msgs::TransformStamped> taken;
  for (const auto& transform : event.getMessage()->transforms) {
    const std::string child = withoutSlash(transform.child_frame_id);
    frames_.insert({child, withoutSlash(transform.header.frame_id)});
    const auto owned = owned_.find(child);
    if (!is_own && owned != owned_.end() && conflict_.empty()) {
      const std::string parent = withoutSlash(transform.header.frame_id);
      conflict_ = publisher + " publishes the tf frame " + child + " (in " + parent + "); " +
                  adviceOn(owned->second, child, parent);
    }
    try {
      buffer_.setTransform(transform, publisher, is_static);
    } catch (const tf2::TransformException&) {
      continue;  // a transform that tf refuses is no answer
    }
    if (!is_own) taken.push_back(transform);
  }
  // After all of them, since one may need another.
  for (const auto& transform : taken) listener_(transform);
}

std::optional<Transform> TfWatch::find(const std::string& target, const std::string& frame,
                                       const ros::Time& stamp) const {
  try {
    return fromMessage(buffer_.lookupTransform(target, frame, stamp).transform);
  } catch (const tf2::TransformException&) {
    return std::nullopt;
  }
}

}  // namespace pcrb
