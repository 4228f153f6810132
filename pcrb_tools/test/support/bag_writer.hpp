#pragma once

#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace pcrb_test {

inline std_msgs::Header headerAt(std::uint32_t sec, std::uint32_t nsec, const std::string& frame) {
  std_msgs::Header header;
  header.stamp = ros::Time(sec, nsec);
  header.frame_id = frame;
  return header;
}

/// How a cloud message is laid out; the points are x y z each.
struct CloudLayout {
  std::uint32_t offset = 0;  ///< of x; y and z follow
  std::uint32_t step = 32;
  std::uint32_t height = 1;
  std::uint32_t row_step = 0;
  std::string color = "rgb";  ///< name of a further field at offset + 16, or none
};

inline sensor_msgs::PointCloud2 makeCloud(const std_msgs::Header& header,
                                          const std::vector<float>& xyz,
                                          const CloudLayout& layout = {}) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header = header;
  cloud.height = layout.height;
  cloud.width = static_cast<std::uint32_t>(xyz.size() / 3) / layout.height;
  cloud.point_step = layout.step;
  cloud.row_step = layout.row_step;
  const auto addField = [&cloud](const std::string& name, std::uint32_t offset) {
    sensor_msgs::PointField field;
    field.name = name;
    field.offset = offset;
    field.datatype = sensor_msgs::PointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
  };
  if (!layout.color.empty()) addField(layout.color, layout.offset + 16);
  addField("z", layout.offset + 8);
  addField("y", layout.offset + 4);
  addField("x", layout.offset);
  cloud.data.assign(xyz.size() / 3 * layout.step, 0xff);
  for (std::size_t i = 0; i != xyz.size() / 3; ++i) {
    std::memcpy(&cloud.data[i * layout.step + layout.offset], &xyz[3 * i], 3 * sizeof(float));
  }
  return cloud;
}

/// A depth image of 4-byte or 2-byte pixels.
template <typename Pixel>
sensor_msgs::Image makeDepth(const std_msgs::Header& header, std::uint32_t width,
                             const std::vector<Pixel>& pixels) {
  sensor_msgs::Image image;
  image.header = header;
  image.width = width;
  image.height = static_cast<std::uint32_t>(pixels.size()) / width;
  image.encoding = sizeof(Pixel) == 4 ? "32FC1" : "16UC1";
  image.step = width * sizeof(Pixel);
  image.data.resize(pixels.size() * sizeof(Pixel));
  std::memcpy(image.data.data(), pixels.data(), image.data.size());
  return image;
}

inline sensor_msgs::CameraInfo makeCamera(const std_msgs::Header& header, double focal,
                                          double center) {
  sensor_msgs::CameraInfo info;
  info.header = header;
  info.D.assign(5, 0.0);
  info.K = {focal, 0, center, 0, focal, center, 0, 0, 1};
  return info;
}

/// Writes messages into a new bag at their own stamps.
class BagWriter {
 public:
  explicit BagWriter(const std::string& path) : bag_(path, rosbag::bagmode::Write) {}

  template <typename Message>
  BagWriter& add(const std::string& topic, const Message& message) {
    bag_.write(topic, message.header.stamp, message);
    return *this;
  }

 private:
  rosbag::Bag bag_;
};

}  // namespace pcrb_test
