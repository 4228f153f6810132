#include "bridge/robot_inputs.hpp"

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>

#include <algorithm>
#include <iterator>
#include <tuple>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_server/message_conversion.hpp"

namespace pcrb {

namespace {

constexpr double kGravity = 9.80665;  // m/s²
constexpr std::uint32_t kMotionQueue = 100;
const ros::Duration kLongestGap(1.0);  // of odometry and IMU that is made up for

/// A node that reads another run's map localizes well, in the wrong place.
void requireMapFileAlone(const std::string& path, std::optional<FileLock>& lock) {
  lock.emplace(path + ".lock");
  if (lock->isHeld()) return;
  throw Error("~map_file: found `" + path + "` in use by " + lock->holder() +
              ", expected a file of this run's own, such as ${TMPDIR}/map.pcd");
}

void writeMapFile(const std::string& path, const PointCloud& map) {
  DatasetCloud cloud;
  cloud.points.reserve(map.size());
  for (const auto& point : map.points) cloud.points.push_back(point.cast<double>());
  writePcd(path, cloud);
}

/// The entries whose keys are among some names.
template <typename Names>
std::map<std::string, int> withNames(std::map<std::string, int> entries, const Names& names) {
  for (auto entry = entries.begin(); entry != entries.end();) {
    entry = names.count(entry->first) > 0 ? std::next(entry) : entries.erase(entry);
  }
  return entries;
}

/// Of those that take scans the entries of nodes that take the initial pose, too; where there is
/// none, as behind a filter of the scans, all entries.
std::map<std::string, int> ofNodes(const std::map<std::string, int>& takers,
                                   const std::map<std::string, int>& others) {
  auto nodes = withNames(takers, others);
  if (!nodes.empty()) return nodes;
  nodes = takers;
  nodes.insert(others.begin(), others.end());
  return nodes;
}

template <typename Message>
ros::Publisher advertise(ros::NodeHandle& node, const std::string& topic, SubscriberNames& names,
                         bool is_latched) {
  return node.advertise<Message>(topic, 1, names.joined(), names.left(), ros::VoidPtr(),
                                 is_latched);
}

nav_msgs::Odometry odometryOf(const StraightMotion::State& state,
                              const BridgeParameters& parameters) {
  nav_msgs::Odometry odometry;
  odometry.pose.pose.position.x = state.position;
  odometry.twist.twist.linear.x = state.velocity;
  odometry.header.frame_id = parameters.odom_frame;
  odometry.child_frame_id = parameters.base_frame;
  odometry.pose.pose.orientation.w = 1.0;
  for (std::size_t i = 0; i < 36; i += 7) {
    odometry.pose.covariance[i] = 1e-6;
    odometry.twist.covariance[i] = 1e-6;
  }
  return odometry;
}

sensor_msgs::Imu imuOf(const StraightMotion::State& state, const BridgeParameters& parameters) {
  sensor_msgs::Imu imu;
  imu.linear_acceleration.x = state.acceleration;
  imu.header.frame_id = parameters.base_frame;
  imu.orientation.w = 1.0;
  imu.orientation_covariance[0] = -1.0;  // orientation is not measured
  imu.linear_acceleration.z = kGravity;
  for (std::size_t i = 0; i < 9; i += 4) {
    imu.angular_velocity_covariance[i] = 1e-6;
    imu.linear_acceleration_covariance[i] = 1e-4;
  }
  return imu;
}

}  // namespace

RobotInputs::RobotInputs(ros::NodeHandle& node, const BridgeParameters& parameters)
    : parameters_(parameters),
      links_(parameters),
      clock_(parameters.has_even_stamps),
      map_listeners_(parameters.observers),
      scan_listeners_(parameters.observers),
      initial_pose_listeners_(parameters.observers) {
  if (!parameters.map_file.empty()) requireMapFileAlone(parameters.map_file, map_file_lock_);
  map_ = advertise<sensor_msgs::PointCloud2>(node, parameters.map_topic, map_listeners_, true);
  scan_ = advertise<sensor_msgs::PointCloud2>(node, parameters.scan_topic, scan_listeners_, false);
  initial_pose_ = advertise<geometry_msgs::PoseWithCovarianceStamped>(
      node, parameters.initialpose_topic, initial_pose_listeners_, false);
  imu_.period = ros::Duration(1.0 / parameters.imu_rate);
  odometry_.period = ros::Duration(1.0 / parameters.odometry_rate);
  if (!parameters.imu_topic.empty()) {
    imu_.publisher = node.advertise<sensor_msgs::Imu>(parameters.imu_topic, kMotionQueue);
  }
  if (!parameters.odometry_topic.empty()) {
    odometry_.publisher =
        node.advertise<nav_msgs::Odometry>(parameters.odometry_topic, kMotionQueue);
  }
}

std::map<std::string, int> RobotInputs::departures() const {
  return ofNodes(scan_listeners_.departures(), initial_pose_listeners_.departures());
}

std::map<std::string, int> RobotInputs::nodes() const {
  return withNames(ofNodes(scan_listeners_.arrivals(), initial_pose_listeners_.arrivals()),
                   allNodes());
}

std::set<std::string> RobotInputs::allNodes() const {
  std::set<std::string> nodes = scan_listeners_.names();
  nodes.merge(map_listeners_.names());
  nodes.merge(initial_pose_listeners_.names());
  return nodes;
}

std::vector<RobotTopic> RobotInputs::untaken() const {
  const std::string cloud = "sensor_msgs/PointCloud2";
  std::vector<RobotTopic> topics;
  const auto add = [&](bool is_taken, const char* parameter, const ros::Publisher& publisher,
                       const std::string& type) {
    if (!is_taken) topics.push_back({parameter, publisher.getTopic(), type});
  };
  add(isScanTaken(), "scan_topic", scan_, cloud);
  const bool is_map_read = !parameters_.map_file.empty();
  add(is_map_read || !map_listeners_.names().empty(), "map_topic", map_, cloud);
  add(!parameters_.send_initialpose || isInitialPoseTaken(), "initialpose_topic", initial_pose_,
      "geometry_msgs/PoseWithCovarianceStamped");
  for (const auto& [stream, parameter, type] :
       {std::tuple(&imu_, "imu_topic", "sensor_msgs/Imu"),
        std::tuple(&odometry_, "odometry_topic", "nav_msgs/Odometry")}) {
    const ros::Publisher& publisher = stream->publisher;
    add(!publisher || publisher.getNumSubscribers() > 0, parameter, publisher, type);
  }
  return topics;
}

void RobotInputs::sendStaticLinks() { links_.sendStatic(now()); }

void RobotInputs::sendMap(const PointCloud& map) {
  if (!parameters_.map_file.empty()) writeMapFile(parameters_.map_file, map);
  map_.publish(toMessage(withIntensity(map), Transform::Identity(),
                         makeHeader(parameters_.map_frame, now())));
}

void RobotInputs::sendInitialPose(const Transform& T_map_body) {
  geometry_msgs::PoseWithCovarianceStamped message;
  message.header = makeHeader(parameters_.map_frame, now());
  message.pose.pose = toMessage(T_map_body);
  const double position = parameters_.initialpose_translation;
  const double angle = parameters_.initialpose_rotation;
  const auto covariance = planarCovariance(position, angle);
  std::copy(covariance.begin(), covariance.end(), message.pose.covariance.begin());
  if (parameters_.has_6dof_covariance) {
    message.pose.covariance[14] = position * position;
    for (const std::size_t i : {3U, 4U}) message.pose.covariance[7 * i] = angle * angle;
  }
  initial_pose_.publish(message);
}

void RobotInputs::setScan(const PointCloud& cloud, const SensorMounting& mounting) {
  scan_cloud_ = withIntensity(cloud);
  scan_mounting_ = mounting;
  makeScan(Transform::Identity());
}

void RobotInputs::makeScan(const Transform& T_first_base) {
  const Transform& E = scan_mounting_.T_base_scan;
  const bool is_there = T_first_base.matrix() == Eigen::Matrix4d::Identity();
  const Transform T_scan_source =
      is_there ? scan_mounting_.T_scan_source  // to the bit: E⁻¹ E is rounded
               : Transform(E.inverse() * T_first_base.inverse() * E * scan_mounting_.T_scan_source);
  scan_message_ =
      toMessage(scan_cloud_, T_scan_source, makeHeader(parameters_.scan_frame, ros::Time()));
  scan_way_ = T_first_base;
}

Transform RobotInputs::odometryAt(const ros::Time& stamp) const {
  return Transform(Eigen::Translation3d(motion_.at(stamp.toSec()).position, 0.0, 0.0));
}

void RobotInputs::stop() {
  const ros::Time time = now();
  sendMotion(time);  // what is sent for a time before the change must be of the motion before it
  motion_.changeTo(0.0, time.toSec());
}

double RobotInputs::timeToStop() { return motion_.timeToSpeed(now().toSec()); }

RobotInputs::SentScan RobotInputs::sendScan(bool is_first_of_problem) {
  const std::int64_t time = toNanoseconds(ros::Time::now());
  const std::int64_t stamp = is_first_of_problem
                                 ? clock_.now(time)
                                 : clock_.next(time, toNanoseconds(parameters_.scans.period));
  const ros::Time time_of_scan = toTime(stamp);
  if (is_first_of_problem) {
    T_odom_first_ = odometryAt(time_of_scan);
    motion_.changeTo(parameters_.speed, time_of_scan.toSec());
  }
  const Transform T_odom_base = odometryAt(time_of_scan);
  links_.sendDynamic(time_of_scan, T_odom_base);
  sendMotion(time_of_scan);
  SentScan sent{stamp, T_odom_first_.inverse() * T_odom_base};
  if (sent.T_first_base.matrix() != scan_way_.matrix()) makeScan(sent.T_first_base);
  scan_message_.header.stamp = time_of_scan;
  scan_.publish(scan_message_);
  return sent;
}

template <typename Make>
void RobotInputs::send(Stream& stream, const Make& make, const ros::Time& until) {
  if (!stream.publisher) return;
  if (stream.last + kLongestGap < until) stream.last = until - stream.period;
  while (stream.last + stream.period <= until) {
    stream.last += stream.period;
    auto message = make(motion_.at(stream.last.toSec()), parameters_);
    message.header.stamp = stream.last;
    stream.publisher.publish(message);
  }
}

void RobotInputs::sendMotion() { sendMotion(now()); }

void RobotInputs::sendMotion(const ros::Time& until) {
  send(imu_, imuOf, until);
  send(odometry_, odometryOf, until);
}

}  // namespace pcrb
