#include "pcrb_tools/registration_client.hpp"

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
  const bool is_prepared =
      method_ && data_set_ == problem->data_set && prepared_stamp_ == problem->target_stamp;
  if (is_prepared) return true;
  if (!method_ || data_set_ != problem->data_set) {
    method_ = make_method_(problem->data_set);
    data_set_ = problem->data_set;
  }
  target_failure_.clear();
  prepared_stamp_ = problem->target_stamp;
  try {
    method_->setTarget(std::make_shared<pcrb::PointCloud>(pcrb::fromMessage(*target)));
  } catch (const pcrb::Error& error) {
    target_failure_ = error.what();
  }
  return true;
}

void RegistrationClient::solve() {
  solved_stamp_ = server_.problem()->header.stamp;
  server_.submit(align());
}

pcrb_msgs::SubmitPose::Request RegistrationClient::align() {
  const auto& problem = server_.problem();
  pcrb_msgs::SubmitPose::Request request;
  request.problem_id = problem->problem_id;
  request.solver_time = std::nan("");
  request.scans_used = 1;
  try {
    if (!target_failure_.empty()) throw pcrb::InvalidProblem(target_failure_);
    const auto guess = problem->has_guess != 0 ? pcrb::fromMessage(problem->initial_guess)
                                               : pcrb::Transform::Identity();
    const auto result = method_->align(pcrb::fromMessage(*server_.source()), guess);
    request.status = pcrb_msgs::SubmitPose::Request::POSE;
    request.pose.header = problem->header;
    request.pose.pose = pcrb::toMessage(result.T_target_source);
    request.solver_time = result.solver_time;
    request.reason = result.reason;
  } catch (const pcrb::Error& error) {
    request.status = pcrb_msgs::SubmitPose::Request::FAILED;
    request.reason = error.what();
  }
  return request;
}

}  // namespace pcrb_tools
