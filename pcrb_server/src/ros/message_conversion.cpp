#include "pcrb_server/message_conversion.hpp"

#include <sensor_msgs/PointField.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/pcd.hpp"

namespace pcrb {

namespace {

template <typename T>
double loadAs(const std::uint8_t* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(value));
  return static_cast<double>(value);
}

auto findField(const sensor_msgs::PointCloud2& message, const std::string& name) {
  return std::find_if(message.fields.begin(), message.fields.end(),
                      [&name](const auto& field) { return field.name == name; });
}

/// Bytes of a number, 0 for types that there are not.
std::size_t sizeOf(const sensor_msgs::PointField& field) {
  constexpr std::array<std::size_t, 9> kSizes{0, 1, 1, 2, 2, 4, 4, 4, 8};  // INT8 (1) to FLOAT64
  return field.datatype < kSizes.size() ? kSizes[field.datatype] : 0;
}

bool isFloat(const sensor_msgs::PointField& field) {
  return field.datatype == sensor_msgs::PointField::FLOAT32 ||
         field.datatype == sensor_msgs::PointField::FLOAT64;
}

bool isReadable(const sensor_msgs::PointField& field, std::size_t step, PointField::Types types) {
  const std::size_t size = sizeOf(field);
  return size > 0 && field.offset + size <= step &&
         (types == PointField::Types::kAll || isFloat(field));
}

sensor_msgs::PointField floatField(const std::string& name, std::uint32_t offset) {
  sensor_msgs::PointField field;
  field.name = name;
  field.offset = offset;
  field.datatype = sensor_msgs::PointField::FLOAT32;
  field.count = 1;
  return field;
}

}  // namespace

namespace {

/// Bytes from a row of points to the next. A row may be padded; `row_step` counts unless there is
/// one row only, it is not given, or the data are exactly the points.
///
/// @throws InvalidProblem  if it is neither, or the rows do not fit the data.
std::size_t rowBytes(const sensor_msgs::PointCloud2& message) {
  const std::size_t packed = std::size_t{message.width} * message.point_step;
  const bool is_packed = message.height <= 1 || message.row_step == 0 ||
                         message.data.size() == packed * message.height;
  const std::size_t row = is_packed ? packed : message.row_step;
  const bool has_points = message.height > 0 && message.point_step > 0;
  const std::size_t needed = has_points ? (message.height - std::size_t{1}) * row + packed : 0;
  if (message.point_step > 0 && row >= packed && needed <= message.data.size()) return row;
  throw InvalidProblem("PointCloud2: found " + std::to_string(message.data.size()) +
                       " bytes of data, expected " +
                       std::to_string(std::size_t{message.width} * message.height) + " points of " +
                       std::to_string(message.point_step) + " bytes in " +
                       std::to_string(message.height) + " rows of " + std::to_string(row));
}

}  // namespace

std::size_t countPoints(const sensor_msgs::PointCloud2& message) {
  if (message.is_bigendian != 0) {
    throw InvalidProblem("PointCloud2: found big-endian data, expected little-endian");
  }
  const std::size_t count = std::size_t{message.width} * message.height;
  if (count > 0) rowBytes(message);  // some drivers leave all else of an empty cloud at 0
  return count;
}

bool hasField(const sensor_msgs::PointCloud2& message, const std::string& name) {
  return findField(message, name) != message.fields.end();
}

bool hasFloatField(const sensor_msgs::PointCloud2& message, const std::string& name) {
  const auto field = findField(message, name);
  return field != message.fields.end() &&
         isReadable(*field, message.point_step, PointField::Types::kFloats);
}

PointField::PointField(const sensor_msgs::PointCloud2& message, const std::string& name,
                       Types types)
    : first_(message.data.data()),
      step_(message.point_step),
      width_(message.width),
      padding_(rowBytes(message) - step_ * width_) {
  const auto field = findField(message, name);
  if (field == message.fields.end()) {
    throw InvalidProblem("PointCloud2: found no field " + name + ", expected x, y and z");
  }
  if (!isReadable(*field, step_, types)) {
    throw InvalidProblem("PointCloud2: found field " + name + " of type " +
                         std::to_string(field->datatype) + " at " + std::to_string(field->offset) +
                         ", expected " +
                         (types == Types::kAll ? "a number" : "FLOAT32 or FLOAT64") + " within " +
                         std::to_string(step_) + " bytes");
  }
  type_ = field->datatype;
  first_ += field->offset;
}

double PointField::operator[](std::size_t point) const {
  const std::uint8_t* bytes = first_ + point * step_;
  if (padding_ > 0) bytes += point / width_ * padding_;
  using Field = sensor_msgs::PointField;
  switch (type_) {
    case Field::FLOAT32:
      return loadAs<float>(bytes);
    case Field::FLOAT64:
      return loadAs<double>(bytes);
    case Field::INT8:
      return loadAs<std::int8_t>(bytes);
    case Field::UINT8:
      return loadAs<std::uint8_t>(bytes);
    case Field::INT16:
      return loadAs<std::int16_t>(bytes);
    case Field::UINT16:
      return loadAs<std::uint16_t>(bytes);
    case Field::INT32:
      return loadAs<std::int32_t>(bytes);
    default:
      return loadAs<std::uint32_t>(bytes);
  }
}

std::vector<double> pointTimes(const sensor_msgs::PointCloud2& message) {
  const auto scaleOf = [](const sensor_msgs::PointField& field) {
    return pointTimeScale(field.name, isFloat(field));
  };
  const auto field = std::find_if(message.fields.begin(), message.fields.end(),
                                  [&](const auto& known) { return scaleOf(known) > 0.0; });
  std::vector<double> times(countPoints(message));
  if (times.empty() || field == message.fields.end()) return {};
  const PointField time(message, field->name, PointField::Types::kAll);
  const double scale = scaleOf(*field);
  for (std::size_t i = 0; i != times.size(); ++i) times[i] = scale * time[i];
  return times;
}

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
  const std::size_t count = countPoints(message);
  const PointField x(message, "x");
  const PointField y(message, "y");
  const PointField z(message, "z");
  std::optional<PointField> intensity;
  if (hasFloatField(message, "intensity")) intensity.emplace(message, "intensity");
  PointCloud cloud;
  cloud.points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3f p = Eigen::Vector3d(x[i], y[i], z[i]).cast<float>();
    if (!p.allFinite()) continue;
    cloud.points.push_back(p);
    if (intensity) cloud.intensity.push_back(static_cast<float>((*intensity)[i]));
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

geometry_msgs::TransformStamped toMessage(const Transform& T, const std_msgs::Header& header,
                                          const std::string& child_frame) {
  const geometry_msgs::Pose pose = toMessage(T);
  geometry_msgs::TransformStamped message;
  message.header = header;
  message.child_frame_id = child_frame;
  message.transform.translation.x = pose.position.x;
  message.transform.translation.y = pose.position.y;
  message.transform.translation.z = pose.position.z;
  message.transform.rotation = pose.orientation;
  return message;
}

std_msgs::Header makeHeader(const std::string& frame, const ros::Time& stamp) {
  std_msgs::Header header;
  header.frame_id = frame;
  header.stamp = stamp;
  return header;
}

Transform fromMessage(const geometry_msgs::Pose& pose) {
  return makeTransform({pose.position.x, pose.position.y, pose.position.z},
                       Eigen::Quaterniond(pose.orientation.w, pose.orientation.x,
                                          pose.orientation.y, pose.orientation.z));
}

Transform fromMessage(const geometry_msgs::Transform& transform) {
  const auto& t = transform.translation;
  const auto& q = transform.rotation;
  return makeTransform({t.x, t.y, t.z}, Eigen::Quaterniond(q.w, q.x, q.y, q.z));
}

std::optional<PoseCovariance> covarianceOf(const geometry_msgs::PoseWithCovariance& estimate) {
  const auto& numbers = estimate.covariance;
  const auto is_zero = [](double number) { return number == 0.0; };
  const auto is_finite = [](double number) { return std::isfinite(number); };
  if (std::all_of(numbers.begin(), numbers.end(), is_zero)) return std::nullopt;
  if (!std::all_of(numbers.begin(), numbers.end(), is_finite)) return std::nullopt;
  PoseCovariance covariance{};
  std::copy(numbers.begin(), numbers.end(), covariance.begin());
  return covariance;
}

}  // namespace pcrb
