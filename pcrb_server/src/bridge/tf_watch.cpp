#include "bridge/tf_watch.hpp"

#include <ros/this_node.h>
#include <tf2/exceptions.h>

#include <vector>

#include "pcrb_server/frame_name.hpp"
#include "pcrb_server/message_conversion.hpp"

namespace pcrb {

namespace {

constexpr double kKeep = 60.0;  // s of transforms to remember
constexpr std::uint32_t kQueue = 1000;

}  // namespace

TfWatch::TfWatch(ros::NodeHandle& node, std::map<std::string, std::string> owned, Listener listener)
    : owned_(std::move(owned)), listener_(std::move(listener)), buffer_(ros::Duration(kKeep)) {
  using Event = ros::MessageEvent<tf2_msgs::TFMessage const>;
  const auto no_delay = ros::TransportHints().tcpNoDelay();
  tf_ = node.subscribe<tf2_msgs::TFMessage>(
      "/tf", kQueue,
      boost::function<void(const Event&)>([this](const Event& event) { take(event, false); }),
      ros::VoidConstPtr(), no_delay);
  tf_static_ = node.subscribe<tf2_msgs::TFMessage>(
      "/tf_static", kQueue,
      boost::function<void(const Event&)>([this](const Event& event) { take(event, true); }));
}

void TfWatch::take(const ros::MessageEvent<tf2_msgs::TFMessage const>& event, bool is_static) {
  const std::string& publisher = event.getPublisherName();
  const bool is_own = publisher == ros::this_node::getName();
  std::vector<geometry_msgs::TransformStamped> taken;
  for (const auto& transform : event.getMessage()->transforms) {
    const std::string child = withoutSlash(transform.child_frame_id);
    const auto owned = owned_.find(child);
    if (!is_own && owned != owned_.end() && rival_.empty()) {
      rival_ = publisher + " publishes the tf frame " + child + "; or set ~" + owned->second +
               ":=none if the localizer publishes " + child + " itself";
    }
    try {
      buffer_.setTransform(transform, publisher, is_static);
    } catch (const tf2::TransformException&) {
      continue;  // a transform that tf refuses is nobody's answer
    }
    if (!is_own) taken.push_back(transform);
  }
  // After all of them, since one may need another.
  for (const auto& transform : taken) listener_(transform);
}

std::optional<Transform> TfWatch::find(const std::string& target, const std::string& frame,
                                       const ros::Time& stamp) const {
  try {
    return fromMessage(buffer_.lookupTransform(target, frame, stamp).transform);
  } catch (const tf2::TransformException&) {
    return std::nullopt;
  }
}

}  // namespace pcrb
