#include "pcrb_server/point_fields.hpp"

#include <sensor_msgs/PointField.h>

#include <algorithm>
#include <cstring>

#include "pcrb_core/error.hpp"

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

/// Bytes of a field that can be read, 0 for other types.
std::size_t floatSize(const sensor_msgs::PointField& field) {
  if (field.datatype == sensor_msgs::PointField::FLOAT64) return sizeof(double);
  return field.datatype == sensor_msgs::PointField::FLOAT32 ? sizeof(float) : 0;
}

bool isReadable(const sensor_msgs::PointField& field, std::size_t step) {
  const std::size_t size = floatSize(field);
  return size > 0 && field.offset + size <= step;
}

}  // namespace

std::size_t countPoints(const sensor_msgs::PointCloud2& message) {
  if (message.is_bigendian != 0) {
    throw InvalidProblem("PointCloud2: found big-endian data, expected little-endian");
  }
  const std::size_t count = std::size_t{message.width} * message.height;
  if (message.point_step == 0 || message.data.size() / message.point_step < count) {
    throw InvalidProblem("PointCloud2: found " + std::to_string(message.data.size()) +
                         " bytes of data, expected " + std::to_string(count) + " points of " +
                         std::to_string(message.point_step) + " bytes");
  }
  return count;
}

bool hasField(const sensor_msgs::PointCloud2& message, const std::string& name) {
  return findField(message, name) != message.fields.end();
}

bool hasFloatField(const sensor_msgs::PointCloud2& message, const std::string& name) {
  const auto field = findField(message, name);
  return field != message.fields.end() && isReadable(*field, message.point_step);
}

PointField::PointField(const sensor_msgs::PointCloud2& message, const std::string& name)
    : first_(message.data.data()), step_(message.point_step) {
  const auto field = findField(message, name);
  if (field == message.fields.end()) {
    throw InvalidProblem("PointCloud2: found no field " + name + ", expected x, y and z");
  }
  is_double_ = floatSize(*field) == sizeof(double);
  if (!isReadable(*field, step_)) {
    throw InvalidProblem("PointCloud2: found field " + name + " of type " +
                         std::to_string(field->datatype) + " at " + std::to_string(field->offset) +
                         ", expected FLOAT32 or FLOAT64 within " + std::to_string(step_) +
                         " bytes");
  }
  first_ += field->offset;
}

double PointField::operator[](std::size_t point) const {
  const std::uint8_t* const bytes = first_ + point * step_;
  return is_double_ ? loadAs<double>(bytes) : loadAs<float>(bytes);
}

}  // namespace pcrb
