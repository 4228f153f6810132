#pragma once

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/PoseWithCovariance.h>
#include <geometry_msgs/TransformStamped.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Header.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pcrb_core/datasets/stamp.hpp"
#include "pcrb_core/point_cloud.hpp"
#include "pcrb_core/pose_covariance.hpp"
#include "pcrb_core/transform.hpp"

/// The one place where the suite's types become ROS messages and back.
namespace pcrb {

/// Number of points of a message. They follow each other by point_step alone: some drivers leave
/// row_step at 0.
///
/// @throws InvalidProblem  if the message is big-endian or its sizes do not fit its data.
std::size_t countPoints(const sensor_msgs::PointCloud2& message);

bool hasField(const sensor_msgs::PointCloud2& message, const std::string& name);

/// Whether there is a field of that name that PointField can read.
bool hasFloatField(const sensor_msgs::PointCloud2& message, const std::string& name);

/// One named field of the points of a message.
class PointField {
 public:
  /// Types of numbers that a field may have: coordinates that are integers have an unknown unit.
  enum class Types { kFloats, kAll };

  /// @param message  must outlive this; its sizes were checked by countPoints.
  /// @throws InvalidProblem  if there is no such field, it is of another type, or it does not fit
  ///                         into point_step.
  PointField(const sensor_msgs::PointCloud2& message, const std::string& name,
             Types types = Types::kFloats);

  double operator[](std::size_t point) const;

 private:
  const std::uint8_t* first_;
  std::size_t step_;
  std::size_t width_;    ///< points of a row
  std::size_t padding_;  ///< bytes behind the points of a row
  std::uint8_t type_ = 0;
};

/// The times of a message's points in seconds, as the driver gives them, from the first field that
/// pointTimeScale() knows.
///
/// @return  empty where there is no such field.
/// @throws InvalidProblem  if the message's sizes do not fit its data.
std::vector<double> pointTimes(const sensor_msgs::PointCloud2& message);

/// A message of T · cloud: float32 x y z (+ intensity where the cloud has it), little-endian,
/// dense, height 1. Points are transformed in double.
///
/// @param T  from the cloud's local frame to the header's frame.
sensor_msgs::PointCloud2 toMessage(const PointCloud& cloud, const Transform& T,
                                   const std_msgs::Header& header);

/// The same without data and header: fields and sizes.
sensor_msgs::PointCloud2 layoutOf(const PointCloud& cloud);

/// The data that belongs to a layout.
void writePoints(const PointCloud& cloud, const Transform& T, std::uint32_t point_step,
                 std::uint8_t* data);

/// The points of a message; fields are found by name, x y z may be FLOAT32 or FLOAT64. Points with
/// a non-finite coordinate are left out. The local origin is zero.
///
/// @throws InvalidProblem  if a field x, y or z is missing or of another type, the message is
///                         big-endian, or its sizes do not fit its data.
PointCloud fromMessage(const sensor_msgs::PointCloud2& message);

/// With intensity, 0 where it is unknown: some localization nodes warn or fail without the field.
inline PointCloud withIntensity(PointCloud cloud) {
  cloud.intensity.resize(cloud.points.size(), 0.0f);
  return cloud;
}

geometry_msgs::Pose toMessage(const Transform& T);

/// For tf: T_frame_child, `frame` being the header's.
geometry_msgs::TransformStamped toMessage(const Transform& T, const std_msgs::Header& header,
                                          const std::string& child_frame);

/// A frame's name without the slash that old nodes put in front of it.
inline std::string withoutSlash(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

/// Exactly, in integers.
inline Stamp stampOf(const ros::Time& time) { return static_cast<Stamp>(time.toNSec()); }

std_msgs::Header makeHeader(const std::string& frame, const ros::Time& stamp);

/// @throws InvalidProblem  for non-finite numbers or a zero quaternion; others are normalised.
Transform fromMessage(const geometry_msgs::Pose& pose);
Transform fromMessage(const geometry_msgs::Transform& transform);

/// None if all numbers are zero, which is what a node leaves that has none, or if one is not
/// finite.
std::optional<PoseCovariance> covarianceOf(const geometry_msgs::PoseWithCovariance& estimate);

}  // namespace pcrb
