#pragma once

#include <ros/node_handle.h>

#include <string>

namespace pcrb {

/// Calls a service of type std_srvs/Empty or std_srvs/Trigger, whichever it is.
///
/// @return  false if nobody offers it, it is of another type, or it says that it failed.
bool callEmptyOrTrigger(ros::NodeHandle& node, const std::string& service);

}  // namespace pcrb
