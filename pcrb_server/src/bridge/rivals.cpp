#include "bridge/rivals.hpp"

#include <ros/master.h>
#include <ros/this_node.h>

#include <algorithm>

#include "pcrb_core/error.hpp"

namespace pcrb {

std::vector<std::string> publishersBeside(const std::vector<std::string>& topics) {
  XmlRpc::XmlRpcValue arguments, response, state;
  arguments[0] = ros::this_node::getName();
  if (!ros::master::execute("getSystemState", arguments, response, state, false)) {
    throw Error("the ROS master does not answer");
  }
  std::vector<std::string> rivals;
  XmlRpc::XmlRpcValue publishers = state[0];  // [[topic, [node, …]], …]
  for (int i = 0; i < publishers.size(); ++i) {
    const std::string topic = publishers[i][0];
    if (std::find(topics.begin(), topics.end(), topic) == topics.end()) continue;
    for (int k = 0; k < publishers[i][1].size(); ++k) {
      const std::string node = publishers[i][1][k];
      if (node != ros::this_node::getName()) rivals.push_back(node + " publishes " + topic);
    }
  }
  return rivals;
}

}  // namespace pcrb
