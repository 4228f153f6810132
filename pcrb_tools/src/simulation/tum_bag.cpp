#include "tum_bag.hpp"

#include <ros/time.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/image_encodings.h>

#include <array>
#include <cstring>

namespace pcrb_tools::simulation {
namespace {

constexpr char kFrame[] = "/openni_rgb_optical_frame";
constexpr std::uint32_t kColorStep =
    32;  // bytes a point: x y z at 0, 4, 8, rgb at 16, the rest unused
constexpr std::uint32_t kPlainStep = 16;
constexpr std::uint32_t kColorOffset = 16;
constexpr std::int64_t kFrameInterval = 33333333;  // ns

std_msgs::Header makeHeader(std::int64_t stamp_ns, int sequence_number) {
  std_msgs::Header header;
  header.seq = static_cast<std::uint32_t>(sequence_number);
  header.stamp.fromNSec(static_cast<std::uint64_t>(stamp_ns));
  header.frame_id = kFrame;
  return header;
}

sensor_msgs::PointField makeField(const char* name, std::uint32_t offset) {
  sensor_msgs::PointField field;
  field.name = name;
  field.offset = offset;
  field.datatype = sensor_msgs::PointField::FLOAT32;
  field.count = 1;
  return field;
}

/// Red, green and blue in the bits of one word, as PCL packs them.
std::uint32_t packColor(const std::uint8_t* color) {
  return static_cast<std::uint32_t>(color[0]) << 16 | static_cast<std::uint32_t>(color[1]) << 8 |
         static_cast<std::uint32_t>(color[2]);
}

/// Point of a pixel in the camera's frame, in float as the driver computes it; NaN depth makes all
/// three NaN.
std::array<float, 3> pointOf(const DepthCamera& camera, std::size_t pixel, float depth) {
  const std::size_t width = static_cast<std::size_t>(camera.width);
  const float u = static_cast<float>(pixel % width);
  const std::size_t row = pixel / width;
  const float v = static_cast<float>(row);
  const float focal = static_cast<float>(camera.focal);
  return {(u - static_cast<float>(camera.center_x)) * depth / focal,
          (v - static_cast<float>(camera.center_y)) * depth / focal, depth};
}

sensor_msgs::PointCloud2 makeCloud(const DepthCamera& camera, const RgbdFrame& frame,
                                   const std_msgs::Header& header, bool with_color) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header = header;
  cloud.width = static_cast<std::uint32_t>(camera.width);
  cloud.height = static_cast<std::uint32_t>(camera.height);
  cloud.fields = {makeField("x", 0), makeField("y", 4), makeField("z", 8)};
  if (with_color) cloud.fields.push_back(makeField("rgb", kColorOffset));
  cloud.point_step = with_color ? kColorStep : kPlainStep;
  cloud.row_step = cloud.point_step * cloud.width;
  cloud.is_dense = false;
  cloud.data.resize(static_cast<std::size_t>(cloud.row_step) * cloud.height);
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    std::uint8_t* bytes = cloud.data.data() + i * cloud.point_step;
    const std::array<float, 3> point = pointOf(camera, i, frame.depth[i]);
    std::memcpy(bytes, point.data(), sizeof(point));
    if (!with_color) continue;
    const std::uint32_t color = packColor(&frame.color[3 * i]);
    std::memcpy(bytes + kColorOffset, &color, sizeof(color));
  }
  return cloud;
}

sensor_msgs::Image makeImage(const DepthCamera& camera, const std_msgs::Header& header,
                             const std::string& encoding, const void* pixels,
                             std::size_t pixel_size) {
  sensor_msgs::Image image;
  image.header = header;
  image.width = static_cast<std::uint32_t>(camera.width);
  image.height = static_cast<std::uint32_t>(camera.height);
  image.encoding = encoding;
  image.step = static_cast<std::uint32_t>(image.width * pixel_size);
  image.data.resize(static_cast<std::size_t>(image.step) * image.height);
  std::memcpy(image.data.data(), pixels, image.data.size());
  return image;
}

sensor_msgs::CameraInfo makeInfo(const DepthCamera& camera, const std_msgs::Header& header) {
  sensor_msgs::CameraInfo info;
  info.header = header;
  info.width = static_cast<std::uint32_t>(camera.width);
  info.height = static_cast<std::uint32_t>(camera.height);
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.0);
  info.K = {camera.focal, 0.0, camera.center_x, 0.0, camera.focal, camera.center_y, 0.0, 0.0, 1.0};
  info.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  info.P = {
      camera.focal, 0.0, camera.center_x, 0.0, 0.0, camera.focal, camera.center_y, 0.0, 0.0, 0.0,
      1.0,          0.0};
  return info;
}

}  // namespace

TumBag::TumBag(const std::string& path, const DepthCamera& camera) : camera_(camera), bag_(path) {}

template <typename Message>
void TumBag::write(const std::string& topic, const Message& message) {
  bag_.write(topic, message.header.stamp, message);
}

void TumBag::writeClouds(const RgbdFrame& frame, std::int64_t stamp_ns, int sequence_number) {
  const std_msgs::Header header = makeHeader(stamp_ns, sequence_number);
  write("/camera/rgb/camera_info", makeInfo(camera_, header));
  if (sequence_number == 0) {  // until the colour camera has warmed up, clouds come without colour
    const std_msgs::Header before = makeHeader(stamp_ns - kFrameInterval, sequence_number);
    write("/camera/rgb/points", makeCloud(camera_, frame, before, false));
  }
  write("/camera/rgb/points", makeCloud(camera_, frame, header, true));
  if (sequence_number % 4 == 0) {
    write("/camera/depth/points", makeCloud(camera_, frame, header, false));
  }
}

void TumBag::writeImages(const RgbdFrame& frame, std::int64_t stamp_ns, int sequence_number) {
  const std_msgs::Header header = makeHeader(stamp_ns, sequence_number);
  const sensor_msgs::CameraInfo info = makeInfo(camera_, header);
  write("/camera/depth/camera_info", info);
  write("/camera/depth/image", makeImage(camera_, header, sensor_msgs::image_encodings::TYPE_32FC1,
                                         frame.depth.data(), sizeof(float)));
  write("/camera/rgb/camera_info", info);
  write("/camera/rgb/image_color",
        makeImage(camera_, header, sensor_msgs::image_encodings::RGB8, frame.color.data(), 3));
}

}  // namespace pcrb_tools::simulation
