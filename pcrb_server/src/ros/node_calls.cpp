#include "ros/node_calls.hpp"

#include <ros/master.h>
#include <ros/names.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <std_srvs/Empty.h>
#include <std_srvs/Trigger.h>
#include <xmlrpcpp/XmlRpcClient.h>
#include <xmlrpcpp/XmlRpcDispatch.h>

namespace pcrb {

std::optional<NodeAddress> addressOf(const std::string& node) {
  XmlRpc::XmlRpcValue arguments, response, uri;
  arguments[0] = ros::this_node::getName();
  arguments[1] = node;
  if (!ros::master::execute("lookupNode", arguments, response, uri, false)) return std::nullopt;
  NodeAddress address;
  if (!ros::network::splitURI(std::string(uri), address.host, address.port)) return std::nullopt;
  return address;
}

std::optional<pid_t> queryPid(const NodeAddress& address, double limit) {
  XmlRpc::XmlRpcClient client(address.host.c_str(), static_cast<int>(address.port), "/");
  XmlRpc::XmlRpcValue arguments, result;
  arguments[0] = ros::this_node::getName();
  if (!client.executeNonBlock("getPid", arguments)) return std::nullopt;
  XmlRpc::XmlRpcDispatch dispatch;
  dispatch.addSource(&client,
                     XmlRpc::XmlRpcDispatch::WritableEvent | XmlRpc::XmlRpcDispatch::Exception);
  dispatch.work(limit);  // ends with the answer, or at once where no node listens
  const bool is_done = client.executeCheckDone(result);
  dispatch.clear();
  // The node answers [1, text, pid].
  const bool is_answer = is_done && !client.isFault() &&
                         result.getType() == XmlRpc::XmlRpcValue::TypeArray && result.size() == 3 &&
                         result[2].getType() == XmlRpc::XmlRpcValue::TypeInt;
  if (!is_answer) return std::nullopt;
  return static_cast<pid_t>(int(result[2]));
}

bool callEmptyOrTrigger(ros::NodeHandle& node, const std::string& service) {
  // A service refuses callers of another type before it does anything.
  std_srvs::Empty empty;
  if (node.serviceClient<std_srvs::Empty>(service).call(empty)) return true;
  std_srvs::Trigger trigger;
  return node.serviceClient<std_srvs::Trigger>(service).call(trigger) &&
         trigger.response.success != 0;
}

ros::ServiceServer offerTrigger(ros::NodeHandle& node, const std::string& name,
                                const std::function<TriggerAnswer()>& action) {
  using std_srvs::Trigger;
  return node.advertiseService<Trigger::Request, Trigger::Response>(
      name, [action](Trigger::Request&, Trigger::Response& response) {
        const TriggerAnswer answer = action();
        response.success = answer.success ? 1 : 0;
        response.message = answer.message;
        return true;
      });
}

std::string describeWaitForStart() {
  return "waiting for the service " + ros::names::resolve("~start") +
         ": ~autostart is false (rosparam delete " + ros::names::resolve("~autostart") +
         ", if that was left by an earlier one)";
}

}  // namespace pcrb
