#include "bridge/tf_links.hpp"

#include "pcrb_server/message_conversion.hpp"

namespace pcrb {

std::vector<geometry_msgs::TransformStamped> TfLinks::links(TfLink kind,
                                                            const ros::Time& stamp) const {
  const auto& p = parameters_;
  std::vector<geometry_msgs::TransformStamped> links;
  const auto add = [&](TfLink wanted, const std::string& parent, const std::string& child) {
    if (wanted != kind) return;
    links.push_back(toMessage(Transform::Identity(), makeHeader(parent, stamp), child));
  };
  add(p.tf_map_odom, p.map_frame, p.odom_frame);
  add(p.tf_odom_base, p.odom_frame, p.base_frame);
  add(p.tf_base_scan, p.base_frame, p.scan_frame);
  return links;
}

void TfLinks::sendStatic(const ros::Time& stamp) {
  const auto links = this->links(TfLink::kStatic, stamp);
  if (!links.empty()) static_.sendTransform(links);
}

void TfLinks::sendDynamic(const ros::Time& stamp) {
  const auto links = this->links(TfLink::kDynamic, stamp);
  if (!links.empty()) dynamic_.sendTransform(links);
}

std::set<std::string> TfLinks::ownedChildren() const {
  std::set<std::string> children;
  for (const TfLink kind : {TfLink::kStatic, TfLink::kDynamic}) {
    for (const auto& link : links(kind, ros::Time())) children.insert(link.child_frame_id);
  }
  return children;
}

}  // namespace pcrb
