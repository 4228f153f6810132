#include <pcrb_msgs/Problem.h>
#include <pcrb_msgs/Ready.h>
#include <pcrb_msgs/SubmitPose.h>
#include <pcrb_msgs/Summary.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <array>
#include <vector>

using Points = std::vector<std::array<float, 3>>;  // x y z, m

Points pointsOf(const sensor_msgs::PointCloud2& cloud) {
  Points points;
  sensor_msgs::PointCloud2ConstIterator<float> x(cloud, "x"), y(cloud, "y"), z(cloud, "z");
  for (; x != x.end(); ++x, ++y, ++z) points.push_back({*x, *y, *z});
  return points;
}

// Your algorithm goes here: the pose T with p_target = T * p_source.
geometry_msgs::Pose align(const Points& /*target*/, const Points& /*source*/,
                          const geometry_msgs::Pose& guess) {
  return guess;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "minimal_client");
  ros::NodeHandle node("/pcrb");
  pcrb_msgs::ProblemConstPtr newest;
  sensor_msgs::PointCloud2ConstPtr target, source;
  bool finished = false;
  const auto problems = node.subscribe<pcrb_msgs::Problem>(
      "problem", 1, [&](const pcrb_msgs::ProblemConstPtr& message) { newest = message; });
  const auto targets = node.subscribe<sensor_msgs::PointCloud2>(
      "target", 1, [&](const sensor_msgs::PointCloud2ConstPtr& message) { target = message; });
  const auto sources = node.subscribe<sensor_msgs::PointCloud2>(
      "source", 1, [&](const sensor_msgs::PointCloud2ConstPtr& message) { source = message; });
  const auto summaries = node.subscribe<pcrb_msgs::Summary>(
      "summary", 1, [&](const pcrb_msgs::SummaryConstPtr&) { finished = true; });
  const auto wait_until = [&](auto condition) {
    while (ros::ok() && !finished && !condition()) {
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
    }
    return ros::ok() && !finished;
  };

  pcrb_msgs::ProblemConstPtr problem;
  while (wait_until([&] { return newest && newest != problem; })) {
    problem = newest;  // another one may be announced at any time: the time limit goes on
    wait_until([&] {
      return newest != problem || (target && target->header.stamp == problem->target_stamp);
    });
    pcrb_msgs::Ready ready;
    ready.request.problem_id = problem->problem_id;
    ros::service::call("/pcrb/ready", ready);
    wait_until([&] {
      return newest != problem || (source && source->header.stamp == problem->header.stamp);
    });
    if (finished || newest != problem) continue;
    pcrb_msgs::SubmitPose submit;
    submit.request.problem_id = problem->problem_id;
    submit.request.pose.header = problem->header;
    submit.request.pose.pose = align(pointsOf(*target), pointsOf(*source), problem->initial_guess);
    ros::service::call("/pcrb/submit_pose", submit);
  }
}
