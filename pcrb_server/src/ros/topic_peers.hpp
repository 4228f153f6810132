#pragma once

#include <ros/single_subscriber_publisher.h>
#include <ros/subscribe_options.h>

#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

/// Other nodes on the topics of this one.
namespace pcrb {

/// What the names of nodes begin with that people look with; they take no part in a run.
inline constexpr const char* kObservers =
    "rviz rqt rosbag rostopic rosout foxglove_bridge rosbridge_websocket";

/// The subscribers of a topic that this process publishes. Thread-safe.
class SubscriberNames {
 public:
  /// Without kObservers.
  SubscriberNames();

  /// @param observers  what names begin with, without namespace, that do not count.
  explicit SubscriberNames(std::vector<std::string> observers);

  /// For NodeHandle::advertise.
  ros::SubscriberStatusCallback joined();
  ros::SubscriberStatusCallback left();

  /// Those there are now, observers excepted.
  std::set<std::string> names() const;

  /// How often each has come, observers excepted.
  std::map<std::string, int> arrivals() const;

  /// How often each has left that ever was there, observers excepted. roscpp may see that late: at
  /// once from ROS 1.15 on, before when it sends next.
  std::map<std::string, int> departures() const;

  bool isObserver(const std::string& node) const;

 private:
  const std::vector<std::string> observers_;
  mutable std::mutex mutex_;
  std::multiset<std::string> names_;
  std::map<std::string, int> departures_;
};

/// Publishers of each topic, as the master knows them.
using PublishersByTopic = std::multimap<std::string, std::string>;

/// @throws Error  if the master does not answer.
PublishersByTopic publishersByTopic();

/// Subscribers of each topic, in the same way.
std::multimap<std::string, std::string> subscribersByTopic();

/// Type of each topic that somebody has told the master, be it a subscriber; `*` where those that
/// are there take any.
/// @throws Error  if the master does not answer.
std::map<std::string, std::string> topicTypes();

/// Nodes that subscribe to a topic of the name, without its namespace, in another namespace than
/// this node's, `NODE subscribes to TOPIC`; observers excepted.
/// @throws Error  if the master does not answer.
std::vector<std::string> subscribersElsewhere(const std::string& name);

/// Other nodes that publish what this one alone should publish.
class ConflictingPublishers {
 public:
  using IsObserver = std::function<bool(const std::string& node)>;

  /// @param self         name of this node.
  /// @param owned        topics that no other node may publish.
  /// @param initialpose  topic for which people's tools have a button: rviz advertises it, and may.
  ConflictingPublishers(std::string self, std::vector<std::string> owned, std::string initialpose,
                        IsObserver is_observer);

  /// A line for each conflict: the node and its topic. Prints a warning for each node that
  /// advertises the initial pose in the middle of a run, once.
  std::vector<std::string> find(const PublishersByTopic& publishers);

  /// From now on a node that advertises the initial pose is no conflict, but warned of.
  void beginRun() { has_begun_ = true; }

 private:
  bool isAllowed(const std::string& node, const std::string& topic);

  std::string self_;
  std::vector<std::string> owned_;
  std::string initialpose_;
  IsObserver is_observer_;
  bool has_begun_ = false;
  std::set<std::string> warned_;  ///< nodes
};

}  // namespace pcrb
