#pragma once

#include <ros/single_subscriber_publisher.h>
#include <ros/subscribe_options.h>

#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace pcrb {

/// What the names of nodes begin with that people look with; they take no part in a run.
inline constexpr const char* kObservers =
    "rviz rqt rosbag rostopic rosout foxglove_bridge rosbridge_websocket";

/// Who subscribes to a topic that this process publishes. Thread-safe.
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

  /// How often each has left that ever was there, observers excepted.
  std::map<std::string, int> departures() const;

  bool isObserver(const std::string& node) const;

 private:
  const std::vector<std::string> observers_;
  mutable std::mutex mutex_;
  std::multiset<std::string> names_;
  std::map<std::string, int> departures_;
};

}  // namespace pcrb
