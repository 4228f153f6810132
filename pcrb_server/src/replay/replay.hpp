#pragma once

#include <ros/callback_queue.h>
#include <ros/spinner.h>

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "pcrb_server/node_main.hpp"
#include "replay/replay_parameters.hpp"
#include "replay/scene_publisher.hpp"

namespace pcrb {

/// Shows a playback at its rate, on the steady clock; can be paused, stepped and looped.
class Replay {
 public:
  Replay(const ReplayParameters& parameters, ShutdownRequest& shutdown);
  ~Replay();
  Replay(const Replay&) = delete;
  Replay& operator=(const Replay&) = delete;

  /// Returns after the last scene, or on shutdown.
  void run();

 private:
  using Clock = std::chrono::steady_clock;

  void offerServices();
  bool waitForTurn();
  void show();
  void pauseAtEnd();
  void writeStamps() const;

  const ReplayParameters& parameters_;
  ShutdownRequest& shutdown_;
  std::unique_ptr<Playback> playback_;

  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_paused_;
  bool is_over_ = false;
  std::size_t steps_ = 0;  ///< scenes that were asked for while paused

  Clock::time_point due_;
  ros::Time last_stamp_;
  std::size_t shown_ = 0;
  std::string stamps_;  ///< text of the stamps file

  ros::NodeHandle node_;
  ros::CallbackQueue service_queue_;
  ScenePublisher publisher_;
  std::vector<ros::ServiceServer> services_;
  ros::AsyncSpinner spinner_;
};

}  // namespace pcrb
