#include "server/serialized_cloud.hpp"

#include <gtest/gtest.h>

#include "pcrb_server/message_conversion.hpp"

namespace pcrb {
namespace {

PointCloud someCloud(bool has_intensity) {
  PointCloud cloud;
  cloud.points = {{1.0f, 2.0f, 3.0f}, {-4.5f, 0.25f, 100.0f}, {7.0f, 8.0f, 9.0f}};
  if (has_intensity) cloud.intensity = {0.5f, 1.5f, 2.5f};
  return cloud;
}

TEST(SerializedCloud, IsTheSerializedMessageToTheLastByte) {
  const Transform T = makeTransform({1, 2, 3}, Eigen::Quaterniond(0.9, 0.1, 0.2, 0.3));
  std_msgs::Header header;
  header.frame_id = "map";
  header.stamp = ros::Time(1234, 567);
  CloudSerializer serializer;
  for (const bool has_intensity : {false, true}) {
    const PointCloud cloud = someCloud(has_intensity);
    SerializedCloud serialized = serializer.serialize(cloud, T, "map");
    serialized.setStamp(header.stamp);
    const auto expected = ros::serialization::serializeMessage(toMessage(cloud, T, header));
    ASSERT_EQ(serialized.message.num_bytes, expected.num_bytes);
    EXPECT_TRUE(std::equal(expected.buf.get(), expected.buf.get() + expected.num_bytes,
                           serialized.message.buf.get()));
  }
}

TEST(SerializedCloud, UsesMemoryAgainOnlyWhenNobodyHoldsIt) {
  CloudSerializer serializer;
  const PointCloud cloud = someCloud(false);
  SerializedCloud first = serializer.serialize(cloud, Transform::Identity(), "map");
  const SerializedCloud second = serializer.serialize(cloud, Transform::Identity(), "map");
  EXPECT_NE(first.message.buf.get(), second.message.buf.get());
  const std::uint8_t* memory = first.message.buf.get();
  first = SerializedCloud();
  const SerializedCloud third = serializer.serialize(cloud, Transform::Identity(), "map");
  EXPECT_EQ(third.message.buf.get(), memory);
}

}  // namespace
}  // namespace pcrb
