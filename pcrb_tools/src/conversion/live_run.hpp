#pragma once

#include <ros/node_handle.h>

#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "conversion/conversion.hpp"
#include "pcrb_server/node_main.hpp"
#include "pcrb_server/node_parameters.hpp"

namespace pcrb_tools {

/// What all live converters are asked for beside the conversion itself.
struct LiveOptions {
  double idle_limit = 0.0;  ///< s without a message after the first one that end it; 0 = never
};

/// Reads the parameters that all live converters have.
LiveOptions readLiveParameters(pcrb::NodeParameters& parameters, ConversionRequest& request);

/// Numbers of a parameter, e.g. "525 525 319.5 239.5"; empty where it is not given.
std::vector<double> readNumbers(pcrb::NodeParameters& parameters, const std::string& name,
                                std::size_t count);

/// Help text of these parameters.
extern const char* const kLiveParametersHelp;

/// The topics of a live conversion.
class LiveInput {
 public:
  /// Subscribes without a limit on the queue: messages are only handed over, and their number is
  /// limited, and what is too much counted, behind it.
  template <typename Message>
  void subscribe(const std::string& topic,
                 std::function<void(const typename Message::ConstPtr&)> take) {
    counts_.emplace(topic, 0);
    subscribers_.push_back(node_.subscribe<Message>(
        topic, 0,
        [this, topic, take](const typename Message::ConstPtr& message) {
          ++counts_.at(topic);
          take(message);
        },
        ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay()));
  }

  /// Handles messages until the node is to end or the topics are idle, and those that have come by
  /// then; notes topics on which nothing came.
  /// @throws what a scan of the conversion has thrown, at once.
  void run(const pcrb::ShutdownRequest& shutdown, const LiveOptions& options,
           Conversion& conversion);

 private:
  bool isIdle(double limit);

  ros::NodeHandle node_;
  std::vector<ros::Subscriber> subscribers_;
  std::map<std::string, std::size_t> counts_;  ///< messages by topic
  std::size_t seen_ = 0;                       ///< messages when one was last new
  std::chrono::steady_clock::time_point last_;
};

}  // namespace pcrb_tools
