#include "bridge/empty_call.hpp"

#include <std_srvs/Empty.h>
#include <std_srvs/Trigger.h>

namespace pcrb {

bool callEmptyOrTrigger(ros::NodeHandle& node, const std::string& service) {
  // A service refuses callers of another type before it does anything.
  std_srvs::Empty empty;
  if (node.serviceClient<std_srvs::Empty>(service).call(empty)) return true;
  std_srvs::Trigger trigger;
  return node.serviceClient<std_srvs::Trigger>(service).call(trigger) &&
         trigger.response.success != 0;
}

}  // namespace pcrb
