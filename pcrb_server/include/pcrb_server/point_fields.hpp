#pragma once

#include <sensor_msgs/PointCloud2.h>

#include <cstddef>
#include <cstdint>
#include <string>

namespace pcrb {

/// Number of points of a message. They follow each other by point_step alone: some drivers leave
/// row_step at 0.
///
/// @throws InvalidProblem  if the message is big-endian or its sizes do not fit its data.
std::size_t countPoints(const sensor_msgs::PointCloud2& message);

bool hasField(const sensor_msgs::PointCloud2& message, const std::string& name);

/// Whether there is a field of that name that PointField can read.
bool hasFloatField(const sensor_msgs::PointCloud2& message, const std::string& name);

/// One named field of the points of a message, FLOAT32 or FLOAT64.
class PointField {
 public:
  /// @param message  must outlive this; its sizes were checked by countPoints.
  /// @throws InvalidProblem  if there is no such field, it is of another type, or it does not fit
  ///                         into point_step.
  PointField(const sensor_msgs::PointCloud2& message, const std::string& name);

  double operator[](std::size_t point) const;

 private:
  const std::uint8_t* first_;
  std::size_t step_;
  bool is_double_;
};

}  // namespace pcrb
