#include "drawing.hpp"

#include <algorithm>
#include <sstream>

namespace pcrb {

namespace {

constexpr double kLettersPerScene = 16.0;  // a letter's height fits so often into what is in view
constexpr double kMinLetter = 0.1;         // m
constexpr double kMaxLetter = 5.0;         // m

Eigen::AlignedBox3f boxOf(const PointCloud& cloud) {
  Eigen::AlignedBox3f box;
  for (const auto& point : cloud.points) box.extend(point);
  return box;
}

}  // namespace

Eigen::Vector3d middleOf(const PointCloud& cloud) {
  if (cloud.points.empty()) return Eigen::Vector3d::Zero();
  return boxOf(cloud).center().cast<double>().array().round();
}

visualization_msgs::Marker textMarker(const std_msgs::Header& header,
                                      const Eigen::Vector3d& position, const std::string& text,
                                      const PointCloud& target) {
  const Eigen::AlignedBox3f box = boxOf(target);
  const double extent = box.isEmpty() ? 0.0 : static_cast<double>(box.diagonal().norm());
  const double letter = std::clamp(extent / kLettersPerScene, kMinLetter, kMaxLetter);
  const double top = box.isEmpty() ? position.z() : static_cast<double>(box.max().z());
  visualization_msgs::Marker marker;
  marker.header = header;
  marker.ns = "error";
  marker.type = visualization_msgs::Marker::TEXT_VIEW_FACING;
  marker.pose.position.x = position.x();
  marker.pose.position.y = position.y();
  marker.pose.position.z = std::max(position.z(), top) + 2.0 * letter;
  marker.pose.orientation.w = 1.0;
  marker.scale.z = letter;
  marker.color.r = marker.color.g = marker.color.b = marker.color.a = 1.0f;
  marker.text = text;
  return marker;
}

std::string errorText(const Result& result) {
  std::ostringstream text;
  text.precision(3);
  text << "error " << result.error << " (initial " << result.initial_misalignment << ")";
  if (result.outcome != Outcome::kReplied) text << '\n' << toString(result.outcome);
  return text.str();
}

}  // namespace pcrb
