#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <string>

namespace pcrb {

/// What a std_srvs/Trigger is answered.
struct TriggerAnswer {
  bool success;
  std::string message;
};

/// Offers a std_srvs/Trigger below a node handle, in whose callback queue the action runs.
ros::ServiceServer offerTrigger(ros::NodeHandle& node, const std::string& name,
                                const std::function<TriggerAnswer()>& action);

}  // namespace pcrb
