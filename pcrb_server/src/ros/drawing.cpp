#include "ros/drawing.hpp"

#include <sstream>

namespace pcrb {

namespace {

constexpr double kLetter = 0.7;  // m, height
constexpr double kAbove = 3.5;   // m, which is above the ceiling of a room

}  // namespace

visualization_msgs::Marker textMarker(const std_msgs::Header& header,
                                      const Eigen::Vector3d& position, const std::string& text) {
  visualization_msgs::Marker marker;
  marker.header = header;
  marker.ns = "error";
  marker.type = visualization_msgs::Marker::TEXT_VIEW_FACING;
  marker.pose.position.x = position.x();
  marker.pose.position.y = position.y();
  marker.pose.position.z = position.z() + kAbove;
  marker.pose.orientation.w = 1.0;
  marker.scale.z = kLetter;
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
