#include "bridge/tf_links.hpp"

#include "pcrb_server/message_conversion.hpp"

namespace pcrb {

std::array<TfLinks::Link, 3> TfLinks::all() const {
  const auto& p = parameters_;
  return {{{p.tf_map_odom, "tf_map_odom", p.map_frame, p.odom_frame},
           {p.tf_odom_base, "tf_odom_base", p.odom_frame, p.base_frame},
           {p.tf_base_scan, "tf_base_scan", p.base_frame, p.scan_frame}}};
}

std::vector<geometry_msgs::TransformStamped> TfLinks::links(TfLink kind,
                                                            const ros::Time& stamp) const {
  std::vector<geometry_msgs::TransformStamped> links;
  for (const Link& link : all()) {
    if (link.kind != kind) continue;
    links.push_back(toMessage(Transform::Identity(), makeHeader(link.parent, stamp), link.child));
  }
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

std::map<std::string, std::string> TfLinks::ownedChildren() const {
  std::map<std::string, std::string> children;
  for (const Link& link : all()) {
    if (link.kind != TfLink::kNone) children.emplace(link.child, link.parameter);
  }
  return children;
}

}  // namespace pcrb
