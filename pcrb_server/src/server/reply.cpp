#include "server/reply.hpp"

#include <algorithm>
#include <cmath>

#include "pcrb_server/message_conversion.hpp"

namespace pcrb {

namespace {

using Request = pcrb_msgs::SubmitPose::Request;

Outcome outcomeOf(std::uint8_t status) {
  if (status == Request::POSE) return Outcome::kReplied;
  return status == Request::FAILED ? Outcome::kFailed : Outcome::kTimedOut;
}

}  // namespace

Reply makeReply(const Request& request, const std::optional<Transform>& T_target_frame) {
  Reply reply;
  reply.outcome = outcomeOf(request.status);
  reply.reason = request.reason;
  if (!std::isnan(request.solver_time)) reply.solver_time = request.solver_time;
  if (request.scans_used > 0) reply.scans_used = request.scans_used;
  reply.cpu_time = request.cpu_time;
  reply.peak_memory = request.peak_memory;
  if (reply.outcome != Outcome::kReplied) {
    if (reply.reason.empty()) reply.reason = "the client gave no reason";
    return reply;
  }
  const auto& p = request.pose.pose.position;
  const auto& q = request.pose.pose.orientation;
  reply.position = {p.x, p.y, p.z};
  reply.orientation = Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized();
  if (T_target_frame) {
    reply.position = *T_target_frame * reply.position;
    reply.orientation =
        (Eigen::Quaterniond(T_target_frame->linear()) * reply.orientation).normalized();
  }
  if (request.has_covariance != 0) {
    reply.covariance.emplace();
    std::copy(request.covariance.begin(), request.covariance.end(), reply.covariance->begin());
    if (T_target_frame)
      reply.covariance = rotatedCovariance(*reply.covariance, T_target_frame->linear());
  }
  return reply;
}

}  // namespace pcrb
