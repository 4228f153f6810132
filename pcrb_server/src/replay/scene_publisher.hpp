#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <map>
#include <string>

#include "pcrb_server/playback/scene.hpp"

namespace pcrb {

/// Publishes scenes; what is latched in a bag is latched here.
class ScenePublisher {
 public:
  explicit ScenePublisher(const ros::NodeHandle& node) : node_(node) {}

  void publish(const Scene& scene) {
    forEachMessage(scene, [this](const char* topic, const auto& message, bool is_latched) {
      using Message = std::decay_t<decltype(message)>;
      ros::Publisher& publisher = publishers_[topic];
      if (!publisher) publisher = node_.advertise<Message>(topic, kQueue, is_latched);
      publisher.publish(message);
    });
  }

 private:
  static constexpr std::uint32_t kQueue = 10;

  ros::NodeHandle node_;
  std::map<std::string, ros::Publisher> publishers_;
};

}  // namespace pcrb
