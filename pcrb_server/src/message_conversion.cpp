#include "pcrb_server/message_conversion.hpp"

#include <sensor_msgs/PointField.h>

#include <cstring>

#include "pcrb_core/error.hpp"

namespace pcrb {

namespace {

sensor_msgs::PointField floatField(const std::string& name, std::uint32_t offset) {
  sensor_msgs::PointField field;
  field.name = name;
  field.offset = offset;
  field.datatype = sensor_msgs::PointField::FLOAT32;
  field.count = 1;
  return field;
}

template <typename T>
double readAs(const std::uint8_t* data) {
  T value;
  std::memcpy(&value, data, sizeof(value));
  return static_cast<double>(value);
}

/// Reads one named FLOAT32 or FLOAT64 field of every point.
class FieldReader {
 public:
  FieldReader(const sensor_msgs::PointCloud2& message, const std::string& name) {
    for (const auto& field : message.fields) {
      if (field.name != name) continue;
      offset_ = field.offset;
      is_double_ = field.datatype == sensor_msgs::PointField::FLOAT64;
      const bool is_float = field.datatype == sensor_msgs::PointField::FLOAT32;
      found_ = (is_double_ || is_float) &&
               std::uint64_t{offset_} + (is_double_ ? 8 : 4) <= message.point_step;
    }
  }

  bool found() const { return found_; }

  double operator()(const std::uint8_t* point) const {
    return is_double_ ? readAs<double>(point + offset_) : readAs<float>(point + offset_);
  }

 private:
  std::uint32_t offset_ = 0;
  bool is_double_ = false;
  bool found_ = false;
};

}  // namespace

sensor_msgs::PointCloud2 layoutOf(const PointCloud& cloud) {
  const bool has_intensity = !cloud.intensity.empty();
  sensor_msgs::PointCloud2 message;
  message.height = 1;
  message.width = static_cast<std::uint32_t>(cloud.size());
  message.fields = {floatField("x", 0), floatField("y", 4), floatField("z", 8)};
  if (has_intensity) message.fields.push_back(floatField("intensity", 12));
  message.is_bigendian = 0;
  message.point_step = has_intensity ? 16 : 12;
  message.row_step = message.point_step * message.width;
  message.is_dense = 1;
  return message;
}

void writePoints(const PointCloud& cloud, const Transform& T, std::uint32_t point_step,
                 std::uint8_t* data) {
  transformPoints(cloud, T, data, point_step);
  for (std::size_t i = 0; i < cloud.intensity.size(); ++i) {
    std::memcpy(data + point_step * i + 12, &cloud.intensity[i], 4);
  }
}

sensor_msgs::PointCloud2 toMessage(const PointCloud& cloud, const Transform& T,
                                   const std_msgs::Header& header) {
  sensor_msgs::PointCloud2 message = layoutOf(cloud);
  message.header = header;
  message.data.resize(message.row_step);
  writePoints(cloud, T, message.point_step, message.data.data());
  return message;
}

PointCloud fromMessage(const sensor_msgs::PointCloud2& message) {
  const FieldReader x(message, "x");
  const FieldReader y(message, "y");
  const FieldReader z(message, "z");
  const FieldReader intensity(message, "intensity");
  if (!x.found() || !y.found() || !z.found()) {
    throw InvalidProblem("PointCloud2: expected fields x, y and z of type FLOAT32 or FLOAT64");
  }
  if (message.is_bigendian != 0) {
    throw InvalidProblem("PointCloud2: found big-endian data, expected little-endian");
  }
  // Some drivers leave row_step at 0: points follow each other by point_step alone.
  const std::size_t count = std::size_t{message.width} * message.height;
  if (message.data.size() / message.point_step < count) {
    throw InvalidProblem("PointCloud2: found " + std::to_string(message.data.size()) +
                         " bytes of data, expected " + std::to_string(count) + " points of " +
                         std::to_string(message.point_step));
  }
  PointCloud cloud;
  cloud.points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t* point = message.data.data() + i * message.point_step;
    const Eigen::Vector3f p = Eigen::Vector3d(x(point), y(point), z(point)).cast<float>();
    if (!p.allFinite()) continue;
    cloud.points.push_back(p);
    if (intensity.found()) cloud.intensity.push_back(static_cast<float>(intensity(point)));
  }
  return cloud;
}

geometry_msgs::Pose toMessage(const Transform& T) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(T.linear()).normalized();
  geometry_msgs::Pose pose;
  pose.position.x = T.translation().x();
  pose.position.y = T.translation().y();
  pose.position.z = T.translation().z();
  pose.orientation.x = q.x();
  pose.orientation.y = q.y();
  pose.orientation.z = q.z();
  pose.orientation.w = q.w();
  return pose;
}

Transform fromMessage(const geometry_msgs::Pose& pose) {
  return makeTransform({pose.position.x, pose.position.y, pose.position.z},
                       Eigen::Quaterniond(pose.orientation.w, pose.orientation.x,
                                          pose.orientation.y, pose.orientation.z));
}

}  // namespace pcrb
