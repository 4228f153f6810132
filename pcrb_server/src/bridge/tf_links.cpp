#include "bridge/tf_links.hpp"

namespace pcrb {

namespace {

geometry_msgs::TransformStamped identity(const std::string& parent, const std::string& child,
                                         const ros::Time& stamp) {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = parent;
  transform.header.stamp = stamp;
  transform.child_frame_id = child;
  transform.transform.rotation.w = 1.0;
  return transform;
}

}  // namespace

std::vector<geometry_msgs::TransformStamped> TfLinks::links(TfLink kind,
                                                            const ros::Time& stamp) const {
  const auto& p = parameters_;
  std::vector<geometry_msgs::TransformStamped> links;
  if (p.tf_map_odom == kind) links.push_back(identity(p.map_frame, p.odom_frame, stamp));
  if (p.tf_odom_base == kind) links.push_back(identity(p.odom_frame, p.base_frame, stamp));
  if (p.tf_base_scan == kind) links.push_back(identity(p.base_frame, p.scan_frame, stamp));
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
