#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/spinner.h>

#include <chrono>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "pcrb_server/node_main.hpp"
#include "pcrb_server/parameter_table.hpp"
#include "pcrb_server/playback/playback.hpp"
#include "pcrb_server/playback/scene.hpp"

namespace pcrb {

/// Parameters of `replay`: what is shown, and how.
struct ReplayParameters {
  enum class Subject { kSequence, kProblems, kRun };

  Subject subject = Subject::kSequence;
  SequenceOptions sequence;
  ProblemsOptions problems;
  RunOptions run;

  double rate = 2.0;  ///< scenes per second
  bool loop = false;
  bool autostart = true;
  bool keep_alive = false;  ///< after the last scene: stay, for viewers that come later
  std::string stamps_file;  ///< which scan was published when; empty = not written
};

extern const ParameterTable kReplayParameters;

/// Reads and checks all private parameters.
///
/// @throws InvalidParameter  listing every mistake.
ReplayParameters readReplayParameters();

std::unique_ptr<Playback> makePlayback(const ReplayParameters& parameters);

/// Publishes scenes; what is latched in a bag is latched here.
class ScenePublisher {
 public:
  explicit ScenePublisher(const ros::NodeHandle& node) : node_(node) {}

  /// Publishes the messages that are due at that time.
  void publish(const Scene& scene, const ros::Time& due);

 private:
  ros::NodeHandle node_;
  std::map<std::string, ros::Publisher> publishers_;
  ros::Publisher caption_;
};

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
  void goBack();
  void show();
  void waitFor(double seconds);
  void pauseAtEnd();
  void writeStamps() const;

  const ReplayParameters& parameters_;
  ShutdownRequest& shutdown_;
  std::unique_ptr<Playback> playback_;

  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_paused_;
  bool is_over_ = false;
  std::size_t steps_ = 0;       ///< scenes that were asked for while paused
  std::size_t steps_back_ = 0;  ///< of those before the one that is shown

  Clock::time_point due_;
  ros::Time last_stamp_;
  std::size_t next_ = 0;  ///< position of the scene that is shown next
  std::string stamps_;    ///< text of the stamps file

  ros::NodeHandle node_;
  ros::CallbackQueue service_queue_;
  ScenePublisher publisher_;
  std::vector<ros::ServiceServer> services_;
  ros::AsyncSpinner spinner_;
};

}  // namespace pcrb
