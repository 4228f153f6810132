#include "ros/topic_peers.hpp"

#include <ros/master.h>
#include <ros/names.h>
#include <ros/this_node.h>

#include <algorithm>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/text.hpp"
#include "ros/notices.hpp"

namespace pcrb {

SubscriberNames::SubscriberNames() : SubscriberNames(splitAtBlanks(kObservers)) {}

SubscriberNames::SubscriberNames(std::vector<std::string> observers)
    : observers_(std::move(observers)) {}

bool SubscriberNames::isObserver(const std::string& node) const {
  const std::string name = node.substr(node.rfind('/') + 1);
  for (const auto& observer : observers_) {
    if (startsWith(name, observer)) return true;
  }
  for (const std::string prefix : {"record_", "play_"}) {  // rosbag's, which end with a time
    const bool is_bag = startsWith(name, prefix) && name.size() > prefix.size() &&
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

std::map<std::string, int> SubscriberNames::arrivals() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  auto arrivals = departures_;
  for (const std::string& name : names_) ++arrivals[name];
  return arrivals;
}

std::map<std::string, int> SubscriberNames::departures() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return departures_;
}

namespace {

constexpr int kPublishers = 0;  // parts of the master's state
constexpr int kSubscribers = 1;

XmlRpc::XmlRpcValue askMaster(const std::string& question) {
  XmlRpc::XmlRpcValue arguments, response, answer;
  arguments[0] = ros::this_node::getName();
  if (!ros::master::execute(question, arguments, response, answer, false)) {
    throw Error("the ROS master does not answer");
  }
  return answer;
}

std::multimap<std::string, std::string> nodesByTopic(int part) {
  XmlRpc::XmlRpcValue state = askMaster("getSystemState");
  std::multimap<std::string, std::string> nodes;
  XmlRpc::XmlRpcValue topics = state[part];  // [[topic, [node, …]], …]
  for (int i = 0; i < topics.size(); ++i) {
    for (int k = 0; k < topics[i][1].size(); ++k) {
      nodes.emplace(std::string(topics[i][0]), std::string(topics[i][1][k]));
    }
  }
  return nodes;
}

}  // namespace

PublishersByTopic publishersByTopic() { return nodesByTopic(kPublishers); }

std::multimap<std::string, std::string> subscribersByTopic() { return nodesByTopic(kSubscribers); }

std::map<std::string, std::string> topicTypes() {
  std::map<std::string, std::string> types;
  XmlRpc::XmlRpcValue topics = askMaster("getTopicTypes");  // [[topic, type], …]
  for (int i = 0; i < topics.size(); ++i) {
    types[std::string(topics[i][0])] = std::string(topics[i][1]);
  }
  return types;
}

std::vector<std::string> subscribersElsewhere(const std::string& name) {
  const std::string own = ros::names::resolve(name);
  const SubscriberNames observers;
  std::vector<std::string> found;
  for (const auto& [topic, node] : nodesByTopic(kSubscribers)) {
    const bool is_elsewhere = topic != own && topic.substr(topic.rfind('/') + 1) == name;
    if (is_elsewhere && !observers.isObserver(node)) {
      found.push_back(node + " subscribes to " + topic);
    }
  }
  return found;
}

ConflictingPublishers::ConflictingPublishers(std::string self, std::vector<std::string> owned,
                                             std::string initialpose, IsObserver is_observer)
    : self_(std::move(self)),
      owned_(std::move(owned)),
      initialpose_(std::move(initialpose)),
      is_observer_(std::move(is_observer)) {}

bool ConflictingPublishers::isAllowed(const std::string& node, const std::string& topic) {
  if (node == self_) return true;
  const bool is_initialpose = topic == initialpose_;
  if (!is_initialpose) return std::find(owned_.begin(), owned_.end(), topic) == owned_.end();
  if (is_observer_(node)) return true;
  if (has_begun_ && warned_.insert(node).second) {
    tellPeople("warning: " + node + " advertises " + topic +
               ": a pose from it would spoil the problem in flight");
  }
  return has_begun_;
}

std::vector<std::string> ConflictingPublishers::find(const PublishersByTopic& publishers) {
  std::vector<std::string> conflicts;
  for (const auto& [topic, node] : publishers) {
    if (!isAllowed(node, topic)) conflicts.push_back(node + " publishes " + topic);
  }
  return conflicts;
}

}  // namespace pcrb
