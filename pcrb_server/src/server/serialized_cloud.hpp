#pragma once

#include <ros/serialization.h>
#include <ros/time.h>
#include <sensor_msgs/PointCloud2.h>

#include <string>
#include <vector>

#include "pcrb_core/point_cloud.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb {

/// A sensor_msgs/PointCloud2 in the form in which it goes over the wire, made before it is needed:
/// what is left to do when a source is published is to write its stamp.
struct SerializedCloud {
  ros::SerializedMessage message;

  void setStamp(const ros::Time& stamp);
};

/// Serializes clouds into memory that it uses again once nobody holds it: megabytes of fresh memory
/// cost more than the points that go into them. Not thread-safe.
class CloudSerializer {
 public:
  /// The message that toMessage() would make, with stamp 0.
  SerializedCloud serialize(const PointCloud& cloud, const Transform& T,
                            const std::string& frame_id);

 private:
  ros::SerializedMessage allocate(std::size_t bytes);

  std::vector<ros::SerializedMessage> buffers_;
};

}  // namespace pcrb

// What roscpp asks of a type that is published as sensor_msgs/PointCloud2.
namespace ros {
namespace message_traits {

template <>
struct MD5Sum<pcrb::SerializedCloud> : MD5Sum<sensor_msgs::PointCloud2> {
  static const char* value(const pcrb::SerializedCloud&) {
    return MD5Sum<sensor_msgs::PointCloud2>::value();
  }
  static const char* value() { return MD5Sum<sensor_msgs::PointCloud2>::value(); }
};

template <>
struct DataType<pcrb::SerializedCloud> : DataType<sensor_msgs::PointCloud2> {
  static const char* value(const pcrb::SerializedCloud&) {
    return DataType<sensor_msgs::PointCloud2>::value();
  }
  static const char* value() { return DataType<sensor_msgs::PointCloud2>::value(); }
};

}  // namespace message_traits

namespace serialization {

template <>
inline SerializedMessage serializeMessage(const pcrb::SerializedCloud& cloud) {
  return cloud.message;
}

}  // namespace serialization
}  // namespace ros
