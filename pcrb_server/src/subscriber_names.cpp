#include "subscriber_names.hpp"

#include <iterator>
#include <sstream>

namespace pcrb {

namespace {

bool beginsWith(const std::string& text, const std::string& prefix) {
  return text.rfind(prefix, 0) == 0;
}

std::vector<std::string> wordsOf(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

}  // namespace

SubscriberNames::SubscriberNames() : SubscriberNames(wordsOf(kObservers)) {}

SubscriberNames::SubscriberNames(std::vector<std::string> observers)
    : observers_(std::move(observers)) {}

bool SubscriberNames::isObserver(const std::string& node) const {
  const std::string name = node.substr(node.rfind('/') + 1);
  for (const auto& observer : observers_) {
    if (beginsWith(name, observer)) return true;
  }
  for (const std::string prefix : {"record_", "play_"}) {  // rosbag's, which end with a time
    const bool is_bag = beginsWith(name, prefix) && name.size() > prefix.size() &&
                        name.find_first_not_of("0123456789", prefix.size()) == std::string::npos;
    if (is_bag) return true;
  }
  return false;
}

ros::SubscriberStatusCallback SubscriberNames::joined() {
  return [this](const ros::SingleSubscriberPublisher& subscriber) {
    const std::string name = subscriber.getSubscriberName();
    if (isObserver(name)) return;
    const std::lock_guard<std::mutex> lock(mutex_);
    names_.insert(name);
    departures_.emplace(name, 0);
  };
}

ros::SubscriberStatusCallback SubscriberNames::left() {
  return [this](const ros::SingleSubscriberPublisher& subscriber) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = names_.find(subscriber.getSubscriberName());
    if (found == names_.end()) return;
    ++departures_[*found];
    names_.erase(found);
  };
}

std::set<std::string> SubscriberNames::names() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return {names_.begin(), names_.end()};
}

std::map<std::string, int> SubscriberNames::departures() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return departures_;
}

}  // namespace pcrb
