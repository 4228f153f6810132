#include <pcrb_msgs/Problem.h>
#include <pcrb_msgs/SubmitPose.h>
#include <ros/ros.h>

#include <array>
#include <atomic>
#include <cmath>
#include <iostream>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace {

constexpr int kThreads = 8;
constexpr int kReportedEvery = 100;

/// What all threads know of the problem announced last and the one before it.
class Ids {
 public:
  void add(const std::string& id) {
    const std::lock_guard<std::mutex> lock(mutex_);
    ids_ = {id, ids_[0]};
  }
  std::array<std::string, 2> get() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return ids_;
  }

 private:
  mutable std::mutex mutex_;
  std::array<std::string, 2> ids_;
};

/// The n-th wrong reply: unknown problem, a NaN, no unit quaternion, no such frame, too late.
pcrb_msgs::SubmitPose::Request wrongReply(int n, const Ids& ids) {
  const auto [newest, previous] = ids.get();
  pcrb_msgs::SubmitPose::Request request;
  request.problem_id = newest;
  request.pose.pose.orientation.w = 1.0;
  switch (n % 5) {
    case 0:
      request.problem_id = "no such problem";
      break;
    case 1:
      request.pose.pose.position.x = std::nan("");
      break;
    case 2:
      request.pose.pose.orientation.w = 2.0;
      break;
    case 3:
      request.pose.header.frame_id = "nowhere";
      break;
    default:
      request.problem_id = previous;
  }
  return request;
}

/// Sends wrong replies as fast as the server answers, until it is gone.
void flood(int first, const Ids& ids, std::atomic<int>& rejected, std::atomic<int>& accepted) {
  ros::NodeHandle node;
  auto client = node.serviceClient<pcrb_msgs::SubmitPose>("submit_pose", true);
  pcrb_msgs::SubmitPose service;
  for (int n = first; ros::ok(); ++n) {
    service.request = wrongReply(n, ids);
    if (!client.call(service)) return;
    if (service.response.accepted != 0) {
      ++accepted;
    } else if (const int count = ++rejected; count % kReportedEvery == 0) {
      std::cout << std::to_string(count) + " so far\n" << std::flush;
    }
  }
}

}  // namespace

/// Floods a benchmark server with wrong replies from several connections at once, beside the client
/// that works; ends with the server, and prints how many replies were rejected and accepted, of the
/// rejected ones each hundred when it is full.
int main(int argc, char** argv) {
  ros::init(argc, argv, "flooding_client");
  ros::NodeHandle node;
  Ids ids;
  const auto problems = node.subscribe<pcrb_msgs::Problem>(
      "problem", 10,
      [&](const pcrb_msgs::ProblemConstPtr& problem) { ids.add(problem->problem_id); });
  ros::AsyncSpinner spinner(1);
  spinner.start();
  ros::service::waitForService("submit_pose");
  std::cout << "flooding" << std::endl;
  std::atomic<int> rejected{0};
  std::atomic<int> accepted{0};
  std::vector<std::thread> threads;
  for (int i = 0; i < kThreads; ++i) {
    threads.emplace_back([&, i] { flood(i, ids, rejected, accepted); });
  }
  for (auto& thread : threads) thread.join();
  std::cout << rejected << " rejected, " << accepted << " accepted" << std::endl;
}
