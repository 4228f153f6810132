#include "subscriber_names.hpp"

namespace pcrb {

bool isObserver(const std::string& node) {
  const std::string name = node.substr(node.rfind('/') + 1);
  for (const char* prefix : {"rviz", "rosbag", "rostopic", "rosout"}) {
    if (name.rfind(prefix, 0) == 0) return true;
  }
  for (const std::string prefix : {"record_", "play_"}) {  // rosbag's, which end with a time
    const bool is_bag = name.rfind(prefix, 0) == 0 && name.size() > prefix.size() &&
                        name.find_first_not_of("0123456789", prefix.size()) == std::string::npos;
    if (is_bag) return true;
  }
  return false;
}

ros::SubscriberStatusCallback SubscriberNames::joined() {
  return [this](const ros::SingleSubscriberPublisher& subscriber) {
    const std::lock_guard<std::mutex> lock(mutex_);
    names_.insert(subscriber.getSubscriberName());
  };
}

ros::SubscriberStatusCallback SubscriberNames::left() {
  return [this](const ros::SingleSubscriberPublisher& subscriber) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = names_.find(subscriber.getSubscriberName());
    if (found == names_.end()) return;
    if (!isObserver(*found)) ++departures_;
    names_.erase(found);
  };
}

std::set<std::string> SubscriberNames::names() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::set<std::string> names;
  for (const auto& name : names_) {
    if (!isObserver(name)) names.insert(name);
  }
  return names;
}

int SubscriberNames::departures() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return departures_;
}

}  // namespace pcrb
