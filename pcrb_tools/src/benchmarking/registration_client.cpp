#include "benchmarking/registration_client.hpp"

#include <algorithm>
#include <cmath>

#include "pcrb_core/error.hpp"
#include "pcrb_server/message_conversion.hpp"

namespace pcrb_tools {

RegistrationClient::RegistrationClient(MethodFactory make_method)
    : make_method_(std::move(make_method)), server_([this] { advance(); }) {}

void RegistrationClient::advance() {
  const auto& problem = server_.problem();
  if (!problem || problem->header.stamp == solved_stamp_ || !prepareTarget()) return;
  if (ready_stamp_ != problem->header.stamp && server_.callReady()) {
    ready_stamp_ = problem->header.stamp;
  }
  if (server_.source()) solve();
}

bool RegistrationClient::prepareTarget() {
  const auto& problem = server_.problem();
  const auto target = server_.target();
  if (!target) return false;
  if (data_set_ == problem->data_set && prepared_stamp_ == problem->target_stamp) return true;
  if (!method_ || data_set_ != problem->data_set) {
    method_ = make_method_(*problem);
    data_set_ = problem->data_set;
  }
  prepared_stamp_ = problem->target_stamp;
  target_failure_ = failureOf(
      [&] { method_->setTarget(std::make_shared<pcrb::PointCloud>(pcrb::fromMessage(*target))); });
  return true;
}

std::optional<std::string> RegistrationClient::failureOf(const std::function<void()>& action) {
  std::string reason = "the method threw ";
  try {
    action();
    return std::nullopt;
  } catch (const pcrb::Error& error) {
    return error.what();
  } catch (const std::exception& error) {
    reason += error.what();
  } catch (...) {
    reason += "what is no std::exception";
  }
  method_.reset();
  return reason;
}

void RegistrationClient::solve() {
  solved_stamp_ = server_.problem()->header.stamp;
  pcrb_msgs::SubmitPose::Request reply;
  reply.problem_id = server_.problem()->problem_id;
  reply.solver_time = std::nan("");
  reply.scans_used = 1;
  auto failure = target_failure_;
  if (!failure) {
    failure = failureOf([&] { align(reply); });
    if (!method_) prepared_stamp_ = ros::Time();  // its successor has no target yet
  }
  if (failure) {
    reply.status = pcrb_msgs::SubmitPose::Request::FAILED;
    reply.reason = *failure;
  }
  server_.submit(reply);
}

void RegistrationClient::align(pcrb_msgs::SubmitPose::Request& reply) {
  const auto& problem = server_.problem();
  const auto guess = problem->has_guess != 0 ? pcrb::fromMessage(problem->initial_guess)
                                             : pcrb::Transform::Identity();
  const auto result = method_->align(pcrb::fromMessage(*server_.source()), guess);
  reply.status = pcrb_msgs::SubmitPose::Request::POSE;
  reply.pose.header = problem->header;
  reply.pose.pose = pcrb::toMessage(result.T_target_source);
  reply.solver_time = result.solver_time;
  if (result.covariance) {
    reply.has_covariance = 1;
    std::copy(result.covariance->begin(), result.covariance->end(), reply.covariance.begin());
  }
  reply.reason = result.reason;
}

}  // namespace pcrb_tools
