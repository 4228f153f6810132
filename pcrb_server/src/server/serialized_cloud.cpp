#include "server/serialized_cloud.hpp"

#include "pcrb_server/message_conversion.hpp"

namespace pcrb {

namespace {

constexpr std::uint32_t kLengthBytes = 4;  // in front of every message and of every array

}  // namespace

void SerializedCloud::setStamp(const ros::Time& stamp) {
  // A header is a sequence number, a stamp and a frame, and comes first.
  ros::serialization::OStream stream(message.message_start + 4, 8);
  stream.next(stamp);
}

ros::SerializedMessage CloudSerializer::allocate(std::size_t bytes) {
  for (const auto& buffer : buffers_) {
    if (buffer.buf.unique() && buffer.num_bytes == bytes) return buffer;
  }
  ros::SerializedMessage message;
  message.num_bytes = bytes;
  message.buf.reset(new std::uint8_t[bytes]);
  message.message_start = message.buf.get() + kLengthBytes;
  for (auto& buffer : buffers_) {
    if (buffer.buf.unique()) return buffer = message;
  }
  buffers_.push_back(message);
  return message;
}

SerializedCloud CloudSerializer::serialize(const PointCloud& cloud, const Transform& T,
                                           const std::string& frame_id) {
  sensor_msgs::PointCloud2 layout = layoutOf(cloud);
  layout.header.frame_id = frame_id;
  const std::uint32_t data_bytes = layout.row_step;
  const std::uint32_t message_bytes = ros::serialization::serializationLength(layout) + data_bytes;
  SerializedCloud serialized{allocate(kLengthBytes + message_bytes)};
  ros::serialization::OStream stream(serialized.message.buf.get(), kLengthBytes + message_bytes);
  stream.next(message_bytes);
  stream.next(layout.header);
  stream.next(layout.height);
  stream.next(layout.width);
  stream.next(layout.fields);
  stream.next(layout.is_bigendian);
  stream.next(layout.point_step);
  stream.next(layout.row_step);
  stream.next(data_bytes);
  writePoints(cloud, T, layout.point_step, stream.advance(data_bytes));
  stream.next(layout.is_dense);
  return serialized;
}

}  // namespace pcrb
