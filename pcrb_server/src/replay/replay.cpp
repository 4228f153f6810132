#include "replay/replay.hpp"

#include <std_msgs/String.h>

#include <algorithm>
#include <iostream>
#include <set>

#include "pcrb_core/io/atomic_file.hpp"
#include "ros/node_calls.hpp"

namespace pcrb {

namespace {

constexpr std::uint32_t kSceneQueue = 10;

/// s: a node that ends drops what it has not sent yet, and who has just subscribed gets nothing.
constexpr double kLastSceneHold = 1.0;

}  // namespace

void ScenePublisher::publish(const Scene& scene, const ros::Time& due) {
  forEachMessage(scene, [&](const char* topic, const auto& message, bool is_latched) {
    if (scene.dueAt(topic) != due) return;
    using Message = std::decay_t<decltype(message)>;
    ros::Publisher& publisher = publishers_[topic];
    if (!publisher) publisher = node_.advertise<Message>(topic, kSceneQueue, is_latched);
    publisher.publish(message);
  });
  if (due != scene.stamp) return;
  if (!caption_) caption_ = node_.advertise<std_msgs::String>(topics::kCaption, 1, true);
  std_msgs::String caption;
  caption.data = scene.caption;
  caption_.publish(caption);
}

Replay::Replay(const ReplayParameters& parameters, ShutdownRequest& shutdown)
    : parameters_(parameters),
      shutdown_(shutdown),
      playback_(makePlayback(parameters)),
      is_paused_(!parameters.autostart),
      due_(Clock::now()),
      publisher_(node_),
      spinner_(1, &service_queue_) {
  offerServices();
  shutdown_.onShutdown([this] {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_over_ = true;
    changed_.notify_all();
  });
  spinner_.start();
}

Replay::~Replay() {
  shutdown_.forget();
  spinner_.stop();
}

void Replay::offerServices() {
  ros::NodeHandle node("~");
  node.setCallbackQueue(&service_queue_);
  const auto offer = [&](const char* name, const char* answer, const auto& change) {
    services_.push_back(offerTrigger(node, name, [this, answer, change] {
      const std::lock_guard<std::mutex> lock(mutex_);
      change();
      changed_.notify_all();
      return TriggerAnswer{true, answer};
    }));
  };
  offer(services::kStart, "playing", [this] { is_paused_ = false; });
  offer(services::kPause, "paused", [this] { is_paused_ = true; });
  offer(services::kStep, "paused, one scene further", [this] {
    is_paused_ = true;
    ++steps_;
  });
  offer(services::kBack, "paused, one scene back", [this] {
    is_paused_ = true;
    ++steps_back_;
  });
}

bool Replay::waitForTurn() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!is_over_) {
    if (is_paused_ && steps_ + steps_back_ > 0) {
      const bool is_back = steps_back_ > 0;
      --(is_back ? steps_back_ : steps_);
      due_ = Clock::now();
      lock.unlock();  // services answer while clouds are read
      if (is_back) goBack();
      return true;
    }
    if (is_paused_) {
      changed_.wait(lock);
      due_ = std::max(due_, Clock::now());  // what was missed in a pause is not caught up on
    } else if (Clock::now() >= due_) {
      return true;
    } else {
      changed_.wait_until(lock, due_);
    }
  }
  return false;
}

/// Makes the scene before the one that is shown the next one; before the first one is the last one.
void Replay::goBack() {
  const std::size_t size = playback_->size();
  next_ = (next_ + 2 * size - 2) % size;
  playback_->seek(next_);
}

void Replay::run() {
  if (!parameters_.autostart) std::cout << describeWaitForStart() << std::endl;
  while (waitForTurn()) {
    show();
    if (next_ > 0 || parameters_.loop) continue;
    if (!parameters_.keep_alive) {
      waitFor(kLastSceneHold);
      break;
    }
    pauseAtEnd();
  }
  if (!parameters_.stamps_file.empty()) writeStamps();
}

void Replay::show() {
  const auto period = std::chrono::duration<double>(1.0 / parameters_.rate);
  due_ = std::max(due_, Clock::now() - std::chrono::duration_cast<Clock::duration>(period)) +
         std::chrono::duration_cast<Clock::duration>(period);
  const double lead = playback_->lead();
  due_ += std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(lead));
  const ros::Time now = std::max(ros::Time::now(), last_stamp_ + ros::Duration(0, 1));
  last_stamp_ = now + ros::Duration(lead);
  const Scene scene = playback_->next(last_stamp_);
  ros::Time reached = now;
  for (const ros::Time& due : std::set<ros::Time>{scene.dueAt(topics::kMap),
                                                  scene.dueAt(topics::kInitialPose), scene.stamp}) {
    waitFor((due - reached).toSec());
    publisher_.publish(scene, due);
    reached = due;
  }
  std::cout << next_ + 1 << "/" << playback_->size() << " " << scene.title << std::endl;
  next_ = (next_ + 1) % playback_->size();
  if (!parameters_.stamps_file.empty()) appendScan(stamps_, scene);
}

void Replay::waitFor(double seconds) {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return is_over_; });
}

void Replay::pauseAtEnd() {
  const std::lock_guard<std::mutex> lock(mutex_);
  is_paused_ = true;
  std::cout << "at the end; ~start plays it again" << std::endl;
}

void Replay::writeStamps() const { writeFileAtomically(parameters_.stamps_file, stamps_); }

}  // namespace pcrb
