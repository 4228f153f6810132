#include <ros/callback_queue.h>
#include <ros/node_handle.h>

#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "conversion/converters.hpp"
#include "conversion/kaist_stream.hpp"
#include "conversion/tum_stream.hpp"
#include "pcrb_core/datasets/pose_file.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_server/node_main.hpp"

namespace pcrb_tools {
namespace {

constexpr const char* kLiveIdentity = "live ";  ///< of a stream, for fingerprints

/// The topics of a live conversion.
class LiveInput {
 public:
  /// Subscribes without a limit on the queue: messages are only handed over, and their number is
  /// limited, and what is too much counted, behind it.
  template <typename Message, typename Take>
  void subscribe(const std::string& topic, Take take) {
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
  void run(const pcrb::ShutdownRequest& shutdown, double idle_limit, Conversion& conversion) {
    const ros::WallDuration period(0.1);
    while (!shutdown.requested() && !isIdle(idle_limit)) {
      ros::getGlobalCallbackQueue()->callAvailable(period);
      conversion.check();
    }
    ros::getGlobalCallbackQueue()->callAvailable();
    for (const auto& [topic, count] : counts_) {
      if (count == 0) conversion.note("nothing came on " + topic);
    }
    subscribers_.clear();
  }

 private:
  bool isIdle(double limit) {
    std::size_t total = 0;
    for (const auto& [topic, count] : counts_) total += count;
    const auto now = std::chrono::steady_clock::now();
    if (total != seen_) last_ = now;
    seen_ = total;
    return limit > 0.0 && total > 0 && std::chrono::duration<double>(now - last_).count() > limit;
  }

  ros::NodeHandle node_;
  std::vector<ros::Subscriber> subscribers_;
  std::map<std::string, std::size_t> counts_;  ///< messages by topic
  std::size_t seen_ = 0;                       ///< messages when one was last new
  std::chrono::steady_clock::time_point last_;
};

template <typename Request>
Request asLive(Request request, const LiveOptions& options) {
  request.live = true;
  request.max_waiting = static_cast<std::size_t>(options.max_waiting);
  return request;
}

void subscribeToTum(const TumOptions& options, TumStream& stream, LiveInput& input) {
  if (options.input == TumInput::kClouds) {
    input.subscribe<sensor_msgs::PointCloud2>(
        options.cloud_topic, [&stream](const auto& cloud) { stream.addCloud(cloud); });
    return;
  }
  input.subscribe<sensor_msgs::Image>(options.depth_topic,
                                      [&stream](const auto& image) { stream.addDepth(image); });
  if (options.intrinsics) return;
  input.subscribe<sensor_msgs::CameraInfo>(
      options.info_topic, [&stream](const auto& info) { stream.setCamera(*info); });
}

}  // namespace

ConversionReport convertLive(const TumRequest& request, const LiveOptions& options,
                             const pcrb::ShutdownRequest& shutdown) {
  const auto [trajectory, notes] =
      pcrb::parseTrajectory(pcrb::FileBytes(request.poses).text(), request.poses);
  Conversion conversion(asLive(request, options), request.sequence, 0);
  announcePoses(trajectory, conversion, notes);
  TumStream stream(trajectory, request.options, request.options.input, kLiveIdentity, conversion);
  LiveInput input;
  subscribeToTum(request.options, stream, input);
  input.run(shutdown, options.idle_limit, conversion);
  stream.finish();
  return conversion.finish();
}

ConversionReport convertLive(const KaistRequest& request, const LiveOptions& options,
                             const pcrb::ShutdownRequest& shutdown) {
  const KaistFrames frames = readFrames(request, nullptr);
  Conversion conversion(asLive(request, options), request.sequence, 0);
  KaistStream stream(frames, request, request.sequence, kLiveIdentity, conversion);
  LiveInput input;
  input.subscribe<sensor_msgs::PointCloud2>(request.left_topic,
                                            [&stream](const auto& scan) { stream.addLeft(scan); });
  input.subscribe<sensor_msgs::PointCloud2>(request.right_topic,
                                            [&stream](const auto& scan) { stream.addRight(scan); });
  input.run(shutdown, options.idle_limit, conversion);
  stream.finish();
  return conversion.finish();
}

}  // namespace pcrb_tools
