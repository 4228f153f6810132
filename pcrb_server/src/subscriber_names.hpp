#pragma once

#include <ros/single_subscriber_publisher.h>
#include <ros/subscribe_options.h>

#include <memory>
#include <mutex>
#include <set>
#include <string>

namespace pcrb {

/// Nodes that people look with (rviz, rosbag, rostopic, rosout); they take no part in a run.
bool isObserver(const std::string& node);

/// Who subscribes to a topic that this process publishes. Thread-safe.
class SubscriberNames {
 public:
  /// For NodeHandle::advertise.
  ros::SubscriberStatusCallback joined();
  ros::SubscriberStatusCallback left();

  /// Those there are now, observers excepted.
  std::set<std::string> names() const;

  /// How many have left so far, observers excepted.
  int departures() const;

 private:
  mutable std::mutex mutex_;
  std::multiset<std::string> names_;
  int departures_ = 0;
};

}  // namespace pcrb
