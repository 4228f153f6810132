#include "pcrb_tools/registration_client.hpp"

#include <pcrb_msgs/Ready.h>

#include <cmath>

#include "pcrb_core/error.hpp"
#include "pcrb_server/message_conversion.hpp"
#include "pcrb_server/topics.hpp"

namespace pcrb_tools {

namespace {

const ros::TransportHints kNoDelay = ros::TransportHints().tcpNoDelay();

/// Calls a service over a connection that is kept, and made anew after the server was restarted.
template <typename Service>
bool call(ros::NodeHandle& node, const char* name, ros::ServiceClient& client, Service& service) {
  if (client.isValid() && client.call(service)) return true;
  client = node.serviceClient<Service>(name, true);
  return client.call(service);
}

}  // namespace

RegistrationClient::RegistrationClient(MethodFactory make_method)
    : make_method_(std::move(make_method)) {
  namespace topics = pcrb::topics;
  problem_subscriber_ = node_.subscribe<pcrb_msgs::Problem>(
      topics::kProblem, 1,
      [this](const pcrb_msgs::ProblemConstPtr& message) {
        problem_ = message;
        advance();
      },
      ros::VoidConstPtr(), kNoDelay);
  target_subscriber_ = node_.subscribe<sensor_msgs::PointCloud2>(
      topics::kTarget, 1,
      [this](const sensor_msgs::PointCloud2ConstPtr& message) {
        target_ = message;
        advance();
      },
      ros::VoidConstPtr(), kNoDelay);
  source_subscriber_ = node_.subscribe<sensor_msgs::PointCloud2>(
      topics::kSource, 1,
      [this](const sensor_msgs::PointCloud2ConstPtr& message) {
        source_ = message;
        advance();
      },
      ros::VoidConstPtr(), kNoDelay);
  summary_subscriber_ = node_.subscribe<pcrb_msgs::Summary>(
      topics::kSummary, 1,
      [this](const pcrb_msgs::SummaryConstPtr& message) { finished_ = message->finished != 0; });
}

void RegistrationClient::advance() {
  if (!problem_ || problem_->header.stamp == solved_stamp_ || !prepareTarget()) return;
  if (ready_stamp_ != problem_->header.stamp) callReady();
  if (source_ && source_->header.stamp == problem_->header.stamp) solve();
}

bool RegistrationClient::prepareTarget() {
  if (!target_ || target_->header.stamp != problem_->target_stamp) return false;
  const bool is_prepared =
      method_ && data_set_ == problem_->data_set && prepared_stamp_ == problem_->target_stamp;
  if (is_prepared) return true;
  if (!method_ || data_set_ != problem_->data_set) {
    method_ = make_method_(problem_->data_set);
    data_set_ = problem_->data_set;
  }
  target_failure_.clear();
  prepared_stamp_ = problem_->target_stamp;
  try {
    method_->setTarget(std::make_shared<pcrb::PointCloud>(pcrb::fromMessage(*target_)));
  } catch (const pcrb::Error& error) {
    target_failure_ = error.what();
  }
  return true;
}

void RegistrationClient::callReady() {
  ready_stamp_ = problem_->header.stamp;
  pcrb_msgs::Ready service;
  service.request.problem_id = problem_->problem_id;
  if (!call(node_, pcrb::services::kReady, ready_, service)) {
    ROS_WARN("the server does not answer on `%s`", ready_.getService().c_str());
    ready_stamp_ = ros::Time();
  }
}

void RegistrationClient::solve() {
  solved_stamp_ = problem_->header.stamp;
  submit(align());
}

pcrb_msgs::SubmitPose::Request RegistrationClient::align() {
  pcrb_msgs::SubmitPose::Request request;
  request.problem_id = problem_->problem_id;
  request.solver_time = std::nan("");
  request.scans_used = 1;
  try {
    if (!target_failure_.empty()) throw pcrb::InvalidProblem(target_failure_);
    const auto guess = problem_->has_guess != 0 ? pcrb::fromMessage(problem_->initial_guess)
                                                : pcrb::Transform::Identity();
    const auto result = method_->align(pcrb::fromMessage(*source_), guess);
    request.status = pcrb_msgs::SubmitPose::Request::POSE;
    request.pose.header = problem_->header;
    request.pose.pose = pcrb::toMessage(result.T_target_source);
    request.solver_time = result.solver_time;
    request.reason = result.reason;
  } catch (const pcrb::Error& error) {
    request.status = pcrb_msgs::SubmitPose::Request::FAILED;
    request.reason = error.what();
  }
  return request;
}

void RegistrationClient::submit(const pcrb_msgs::SubmitPose::Request& request) {
  pcrb_msgs::SubmitPose service;
  service.request = request;
  if (!call(node_, pcrb::services::kSubmitPose, submit_, service)) {
    ROS_WARN("the server does not answer on `%s`", submit_.getService().c_str());
  } else if (service.response.accepted == 0) {
    ROS_WARN("reply rejected: %s", service.response.message.c_str());
  }
}

}  // namespace pcrb_tools
