#pragma once

#include <ros/message_event.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "pcrb_core/transform.hpp"

namespace pcrb {

/// Listens to tf: looks frames up, and sees who publishes what.
class TfWatch {
 public:
  /// Called for every transform of /tf that another node publishes.
  using Listener = std::function<void(const geometry_msgs::TransformStamped&)>;

  /// @param owned  child frames whose publisher is this node alone, each with the parameter that
  ///               leaves it to others.
  TfWatch(ros::NodeHandle& node, std::map<std::string, std::string> owned, Listener listener);

  /// T_target_frame at a time (0: the newest), or nothing where tf does not connect the two.
  std::optional<Transform> find(const std::string& target, const std::string& frame,
                                const ros::Time& stamp) const;

  /// Who publishes a child frame that this node owns, which, and what to do if that is as it should
  /// be; empty if nobody does.
  const std::string& rival() const { return rival_; }

 private:
  void take(const ros::MessageEvent<tf2_msgs::TFMessage const>& event, bool is_static);

  std::map<std::string, std::string> owned_;
  Listener listener_;
  std::string rival_;
  tf2::BufferCore buffer_;
  ros::Subscriber tf_;
  ros::Subscriber tf_static_;
};

}  // namespace pcrb
