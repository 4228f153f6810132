#pragma once

#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

/// Calls from node to node: for its process, and services without arguments.
namespace pcrb {

/// Address of a node's own port.
struct NodeAddress {
  std::string host;
  std::uint32_t port = 0;
};

/// The address under which the master knows a node, dead or alive: one that was killed stays
/// entered. Needs no ros::start().
std::optional<NodeAddress> addressOf(const std::string& node);

/// Asks the node at an address for its process id; nothing if none answers within `limit` s.
std::optional<pid_t> queryPid(const NodeAddress& address, double limit);

/// Calls a service of type std_srvs/Empty or std_srvs/Trigger, whichever it is.
///
/// @return  false if no node offers it, it is of another type, or it says that it failed.
bool callEmptyOrTrigger(ros::NodeHandle& node, const std::string& service);

/// Response of a std_srvs/Trigger.
struct TriggerAnswer {
  bool success = false;
  std::string message;
};

/// Offers a std_srvs/Trigger below a node handle, in whose callback queue the action runs; its
/// response is the action's.
ros::ServiceServer offerTrigger(ros::NodeHandle& node, const std::string& name,
                                const std::function<TriggerAnswer()>& action);

/// What a node says that waits for its service `~start`. A master keeps the `_autostart:=false` of
/// an earlier node of that name.
std::string describeWaitForStart();

}  // namespace pcrb
