#include "trigger_service.hpp"

#include <std_srvs/Trigger.h>

namespace pcrb {

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

}  // namespace pcrb
