#include "node_place.hpp"

#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <xmlrpcpp/XmlRpcClient.h>
#include <xmlrpcpp/XmlRpcDispatch.h>

namespace pcrb {

std::optional<NodePlace> placeOf(const std::string& node) {
  XmlRpc::XmlRpcValue arguments, response, uri;
  arguments[0] = ros::this_node::getName();
  arguments[1] = node;
  if (!ros::master::execute("lookupNode", arguments, response, uri, false)) return std::nullopt;
  NodePlace place;
  if (!ros::network::splitURI(std::string(uri), place.host, place.port)) return std::nullopt;
  return place;
}

std::optional<pid_t> askForProcess(const NodePlace& place, double limit) {
  XmlRpc::XmlRpcClient client(place.host.c_str(), static_cast<int>(place.port), "/");
  XmlRpc::XmlRpcValue arguments, result;
  arguments[0] = ros::this_node::getName();
  if (!client.executeNonBlock("getPid", arguments)) return std::nullopt;
  XmlRpc::XmlRpcDispatch dispatch;
  dispatch.addSource(&client,
                     XmlRpc::XmlRpcDispatch::WritableEvent | XmlRpc::XmlRpcDispatch::Exception);
  dispatch.work(limit);  // ends with the answer, or at once where nobody listens
  const bool is_done = client.executeCheckDone(result);
  dispatch.clear();
  // The node answers [1, text, pid].
  const bool is_answer = is_done && !client.isFault() &&
                         result.getType() == XmlRpc::XmlRpcValue::TypeArray && result.size() == 3 &&
                         result[2].getType() == XmlRpc::XmlRpcValue::TypeInt;
  if (!is_answer) return std::nullopt;
  return static_cast<pid_t>(int(result[2]));
}

}  // namespace pcrb
