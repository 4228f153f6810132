#include "bridge/rivals.hpp"

#include <ros/master.h>
#include <ros/this_node.h>

#include <algorithm>
#include <iostream>

#include "pcrb_core/error.hpp"

namespace pcrb {

Rivals::Rivals(std::vector<std::string> owned, std::string initialpose, IsObserver is_observer)
    : owned_(std::move(owned)),
      initialpose_(std::move(initialpose)),
      is_observer_(std::move(is_observer)) {}

bool Rivals::isLetPass(const std::string& node, const std::string& topic) {
  if (node == ros::this_node::getName()) return true;
  const bool is_initialpose = topic == initialpose_;
  if (!is_initialpose) return std::find(owned_.begin(), owned_.end(), topic) == owned_.end();
  if (is_observer_(node)) return true;
  if (has_begun_ && warned_.insert(node).second) {
    std::cout << "warning: " << node << " advertises " << topic
              << ": a pose from it would spoil the problem in flight" << std::endl;
  }
  return has_begun_;
}

void Rivals::refuse(const std::string& tf_rival) {
  XmlRpc::XmlRpcValue arguments, response, state;
  arguments[0] = ros::this_node::getName();
  if (!ros::master::execute("getSystemState", arguments, response, state, false)) {
    throw Error("the ROS master does not answer");
  }
  std::string found;
  XmlRpc::XmlRpcValue publishers = state[0];  // [[topic, [node, …]], …]
  for (int i = 0; i < publishers.size(); ++i) {
    const std::string topic = publishers[i][0];
    for (int k = 0; k < publishers[i][1].size(); ++k) {
      const std::string node = publishers[i][1][k];
      if (!isLetPass(node, topic)) found += "\n  " + node + " publishes " + topic;
    }
  }
  if (!tf_rival.empty()) found += "\n  " + tf_rival;
  if (found.empty()) return;
  throw Error("another node does what the bridge does: start the localizer alone" + found);
}

}  // namespace pcrb
