#include "pcrb_server/message_conversion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

PointCloud threePoints() {
  PointCloud cloud;
  cloud.points = {{1.0f, 2.0f, 3.0f}, {-4.5f, 0.25f, 100.0f}, {0.0f, 0.0f, 0.0f}};
  return cloud;
}

TEST(MessageConversion, ACloudSurvivesItsMessage) {
  PointCloud cloud = threePoints();
  EXPECT_EQ(fromMessage(toMessage(cloud, Transform::Identity(), {})).points, cloud.points);
  cloud.intensity = {0.5f, -1.0f, 7.0f};
  const PointCloud again = fromMessage(toMessage(cloud, Transform::Identity(), {}));
  EXPECT_EQ(again.points, cloud.points);
  EXPECT_EQ(again.intensity, cloud.intensity);
}

TEST(MessageConversion, MovesPointsByTheTransform) {
  const Transform T = makeTransform({1, 2, 3}, Eigen::Quaterniond(0, 0, 0, 1));  // half a turn
  const PointCloud moved = fromMessage(toMessage(threePoints(), T, {}));
  EXPECT_LT((moved.points[0] - Eigen::Vector3f(0, 0, 6)).norm(), 1e-6f);
}

TEST(MessageConversion, ReadsOrganizedCloudsWithPaddingDoublesAndNoRowStep) {
  sensor_msgs::PointCloud2 message;
  message.height = 2;
  message.width = 1;
  message.point_step = 32;
  message.data.resize(64);
  for (int i = 0; i < 3; ++i) {
    sensor_msgs::PointField field;
    field.name = std::string(1, static_cast<char>('x' + i));
    field.offset = static_cast<std::uint32_t>(8 * i);
    field.datatype = sensor_msgs::PointField::FLOAT64;
    field.count = 1;
    message.fields.push_back(field);
    const double value = i + 0.5;
    std::memcpy(message.data.data() + 8 * i, &value, 8);
    const double nan = std::nan("");
    std::memcpy(message.data.data() + 32 + 8 * i, &nan, 8);
  }
  const PointCloud cloud = fromMessage(message);
  ASSERT_EQ(cloud.size(), 1u);  // the NaN is no point
  EXPECT_EQ(cloud.points[0], Eigen::Vector3f(0.5f, 1.5f, 2.5f));
}

/// Two rows of the same three points, each followed by bytes that are no point.
sensor_msgs::PointCloud2 paddedRows(std::uint32_t padding) {
  sensor_msgs::PointCloud2 message = toMessage(threePoints(), Transform::Identity(), {});
  message.data.resize(message.row_step + padding, 0x41);
  message.data.insert(message.data.end(), message.data.begin(), message.data.end());
  message.height = 2;
  message.row_step += padding;
  return message;
}

TEST(MessageConversion, ReadsRowsWithBytesBetweenThem) {
  sensor_msgs::PointCloud2 message = paddedRows(20);
  const PointCloud cloud = fromMessage(message);
  ASSERT_EQ(cloud.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(cloud.points[i], threePoints().points[i % 3]) << i;
  message.data.resize(message.data.size() - 20);  // the last row's may be missing
  EXPECT_EQ(fromMessage(message).points, cloud.points);
  message.data.resize(message.data.size() - 1);
  EXPECT_THROW(fromMessage(message), InvalidProblem);
}

TEST(MessageConversion, TakesRowsAsPackedWithoutARowStepOrWhereTheDataLeaveNoDoubt) {
  sensor_msgs::PointCloud2 message = paddedRows(0);
  const PointCloud cloud = fromMessage(message);
  for (const std::uint32_t row_step : {0U, 1U, 1000U}) {
    message.row_step = row_step;
    EXPECT_EQ(fromMessage(message).points, cloud.points) << row_step;
  }
  message.data.push_back(0);
  EXPECT_THROW(fromMessage(message), InvalidProblem);  // rows of 1000 bytes are not there
}

TEST(MessageConversion, RejectsMessagesThatDoNotHoldWhatTheySay) {
  const sensor_msgs::PointCloud2 good = toMessage(threePoints(), Transform::Identity(), {});
  sensor_msgs::PointCloud2 message = good;
  message.width = 4;
  EXPECT_THROW(fromMessage(message), InvalidProblem);
  message = good;
  message.fields.pop_back();
  EXPECT_THROW(fromMessage(message), InvalidProblem);
  message = good;
  message.fields[2].offset = 9;
  EXPECT_THROW(fromMessage(message), InvalidProblem);
  message = good;
  message.fields[0].datatype = sensor_msgs::PointField::INT32;
  EXPECT_THROW(fromMessage(message), InvalidProblem);
  message = good;
  message.is_bigendian = 1;
  EXPECT_THROW(fromMessage(message), InvalidProblem);
  EXPECT_THROW(fromMessage(sensor_msgs::PointCloud2()), InvalidProblem);
}

TEST(MessageConversion, ACloudOfNoPointsNeedsNothingElse) {
  EXPECT_EQ(countPoints(sensor_msgs::PointCloud2()), 0u);
  sensor_msgs::PointCloud2 message = toMessage(threePoints(), Transform::Identity(), {});
  message.width = 0;
  message.data.clear();
  EXPECT_EQ(fromMessage(message).size(), 0u);
  EXPECT_TRUE(pointTimes(message).empty());
}

/// Two points with a field `t` of a type.
template <typename Number>
std::vector<double> timesAs(std::uint8_t type, const std::string& name, Number first,
                            Number second) {
  sensor_msgs::PointCloud2 message;
  message.width = 1;
  message.height = 2;
  message.point_step = 12;
  message.row_step = 16;  // with bytes between rows
  message.data.resize(32);
  std::memcpy(&message.data[4], &first, sizeof(first));
  std::memcpy(&message.data[20], &second, sizeof(second));
  sensor_msgs::PointField field;
  field.name = name;
  field.offset = 4;
  field.datatype = type;
  field.count = 1;
  message.fields = {field};
  return pointTimes(message);
}

TEST(MessageConversion, TimesOfPointsAreFloatsInSecondsAndIntegersInNanoseconds) {
  using Field = sensor_msgs::PointField;
  EXPECT_EQ(timesAs<float>(Field::FLOAT32, "time", 0.25F, 0.5F), (std::vector<double>{0.25, 0.5}));
  EXPECT_EQ(timesAs<double>(Field::FLOAT64, "timestamp", 1.5e9, 0.5),
            (std::vector<double>{1.5e9, 0.5}));
  EXPECT_EQ(timesAs<std::uint32_t>(Field::UINT32, "t", 0, 4'000'000'000U),
            (std::vector<double>{0, 4}));
  EXPECT_EQ(timesAs<std::int32_t>(Field::INT32, "offset_time", -1'000'000'000, 0),
            (std::vector<double>{-1, 0}));
  EXPECT_TRUE(timesAs<float>(Field::FLOAT32, "ring", 1.0F, 2.0F).empty());
  EXPECT_THROW(timesAs<float>(9, "time", 0, 0), InvalidProblem);
}

TEST(MessageConversion, APoseSurvivesItsMessage) {
  const Transform T = makeTransform({1, -2, 3}, Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5));
  EXPECT_TRUE(fromMessage(toMessage(T)).isApprox(T, 1e-15));
  EXPECT_THROW(fromMessage(geometry_msgs::Pose()), InvalidProblem);
}

}  // namespace
}  // namespace pcrb
