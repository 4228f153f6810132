/// What the server adds to the transport, in two roles each of its own process:
///   bare_publisher POINTS COUNT   publishes clouds one by one, each after the answer to the last
///   bare_subscriber               answers every cloud over a persistent service
///   instant_client                a client of benchmark_server that answers every problem at once
/// The first and the last print the median of their period in ms. `run_server_overhead` starts
/// them.

#include <pcrb_msgs/Problem.h>
#include <pcrb_msgs/Ready.h>
#include <pcrb_msgs/SubmitPose.h>
#include <pcrb_msgs/Summary.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_srvs/Empty.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <iostream>
#include <mutex>
#include <string>
#include <vector>

#include "pcrb_server/message_conversion.hpp"
#include "pcrb_server/topics.hpp"

namespace {

using Clock = std::chrono::steady_clock;

const ros::TransportHints kNoDelay = ros::TransportHints().tcpNoDelay();
constexpr std::size_t kWarmUp = 20;  // periods that do not count

/// Times between calls of tick(), in ms.
class Periods {
 public:
  void tick() {
    const auto now = Clock::now();
    if (last_ != Clock::time_point()) {
      periods_.push_back(std::chrono::duration<double, std::milli>(now - last_).count());
    }
    last_ = now;
  }

  void print() {
    if (periods_.size() <= kWarmUp) return;
    periods_.erase(periods_.begin(), periods_.begin() + kWarmUp);
    std::sort(periods_.begin(), periods_.end());
    std::cout << periods_[periods_.size() / 2] << std::endl;
  }

 private:
  Clock::time_point last_;
  std::vector<double> periods_;
};

int publishBare(std::size_t points, int count) {
  ros::NodeHandle node;
  std::mutex mutex;
  std::condition_variable changed;
  int answers = 0;
  const auto publisher = node.advertise<sensor_msgs::PointCloud2>("bare_cloud", 1);
  const auto answer = node.advertiseService<std_srvs::Empty::Request, std_srvs::Empty::Response>(
      "bare_answer", [&](std_srvs::Empty::Request&, std_srvs::Empty::Response&) {
        const std::lock_guard<std::mutex> lock(mutex);
        ++answers;
        changed.notify_all();
        return true;
      });
  pcrb::PointCloud cloud;
  cloud.points.assign(points, Eigen::Vector3f::Ones());
  const auto message = boost::make_shared<sensor_msgs::PointCloud2>(
      pcrb::toMessage(cloud, pcrb::Transform::Identity(), {}));
  ros::AsyncSpinner spinner(2);
  spinner.start();
  while (publisher.getNumSubscribers() == 0) ros::WallDuration(0.01).sleep();
  Periods periods;
  for (int i = 0; i < count && ros::ok(); ++i) {
    periods.tick();
    publisher.publish(message);
    std::unique_lock<std::mutex> lock(mutex);
    changed.wait(lock, [&] { return answers > i; });
  }
  periods.print();
  return 0;
}

int subscribeBare() {
  ros::NodeHandle node;
  ros::service::waitForService("bare_answer");
  ros::ServiceClient answer = node.serviceClient<std_srvs::Empty>("bare_answer", true);
  const auto subscriber = node.subscribe<sensor_msgs::PointCloud2>(
      "bare_cloud", 1,
      [&](const sensor_msgs::PointCloud2ConstPtr&) {
        std_srvs::Empty service;
        answer.call(service);
      },
      ros::VoidConstPtr(), kNoDelay);
  ros::spin();
  return 0;
}

int answerAtOnce() {
  ros::NodeHandle node("pcrb");
  namespace topics = pcrb::topics;
  ros::service::waitForService("pcrb/submit_pose");
  auto ready = node.serviceClient<pcrb_msgs::Ready>(pcrb::services::kReady, true);
  auto submit = node.serviceClient<pcrb_msgs::SubmitPose>(pcrb::services::kSubmitPose, true);
  Periods periods;
  std::string problem_id;
  const auto problems = node.subscribe<pcrb_msgs::Problem>(
      topics::kProblem, 1,
      [&](const pcrb_msgs::ProblemConstPtr& problem) {
        periods.tick();
        problem_id = problem->problem_id;
        pcrb_msgs::Ready service;
        service.request.problem_id = problem_id;
        ready.call(service);
      },
      ros::VoidConstPtr(), kNoDelay);
  const auto sources = node.subscribe<sensor_msgs::PointCloud2>(
      topics::kSource, 1,
      [&](const sensor_msgs::PointCloud2ConstPtr& source) {
        pcrb_msgs::SubmitPose service;
        service.request.problem_id = problem_id;
        service.request.pose.header = source->header;
        service.request.pose.pose.orientation.w = 1.0;
        submit.call(service);
      },
      ros::VoidConstPtr(), kNoDelay);
  bool is_over = false;
  const auto end = node.subscribe<pcrb_msgs::Summary>(
      topics::kSummary, 1, [&](const pcrb_msgs::SummaryConstPtr&) { is_over = true; });
  while (ros::ok() && !is_over) ros::getGlobalCallbackQueue()->callOne(ros::WallDuration(0.1));
  periods.print();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "server_overhead_benchmark", ros::init_options::AnonymousName);
  const std::string role = argc > 1 ? argv[1] : "";
  if (role == "bare_publisher" && argc == 4) {
    return publishBare(std::strtoul(argv[2], nullptr, 10), std::atoi(argv[3]));
  }
  if (role == "bare_subscriber") return subscribeBare();
  if (role == "instant_client") return answerAtOnce();
  std::cerr << "server_overhead_benchmark: expected a role, see run_server_overhead" << std::endl;
  return 2;
}
