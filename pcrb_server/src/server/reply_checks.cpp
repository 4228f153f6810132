#include "server/reply_checks.hpp"

#include <algorithm>
#include <cmath>

namespace pcrb {

namespace {

using Request = pcrb_msgs::SubmitPose::Request;
using Response = pcrb_msgs::SubmitPose::Response;

constexpr double kUnitQuaternionTolerance = 1e-3;
constexpr double kLargestNumber = 1e100;  // beyond it, composing transforms may overflow

bool isComposable(double number) { return std::abs(number) <= kLargestNumber; }

bool isFinite(const Request& request) {
  const auto& p = request.pose.pose.position;
  const auto& q = request.pose.pose.orientation;
  for (const double number : {p.x, p.y, p.z, q.x, q.y, q.z, q.w}) {
    if (!isComposable(number)) return false;
  }
  return request.has_covariance == 0 ||
         std::all_of(request.covariance.begin(), request.covariance.end(), isComposable);
}

std::optional<Rejection> checkPose(const Request& request) {
  if (!isFinite(request)) {
    return Rejection{Response::NOT_FINITE,
                     "found a NaN, infinite or huge number in the pose, expected finite ones"};
  }
  const auto& q = request.pose.pose.orientation;
  const double norm = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  if (std::abs(norm - 1.0) > kUnitQuaternionTolerance) {
    return Rejection{Response::NOT_UNIT_QUATERNION,
                     "found a quaternion of norm " + std::to_string(norm) + ", expected 1"};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Rejection> checkContent(const Request& request) {
  if (request.status > Request::TIMED_OUT) {
    return Rejection{Response::NOT_FINITE,
                     "found status " + std::to_string(request.status) + ", expected 0, 1 or 2"};
  }
  const double time = request.solver_time;
  if (!std::isnan(time) && !(time >= 0.0 && std::isfinite(time))) {
    return Rejection{Response::NOT_FINITE, "found solver_time " + std::to_string(time) +
                                               ", expected 0 or more, or NaN for unknown"};
  }
  if (!(request.cpu_time >= 0.0 && std::isfinite(request.cpu_time))) {
    return Rejection{Response::NOT_FINITE, "found cpu_time " + std::to_string(request.cpu_time) +
                                               ", expected 0 or more, 0 for unknown"};
  }
  return request.status == Request::POSE ? checkPose(request) : std::nullopt;
}

std::optional<Rejection> checkPlaced(const Request& request, const Transform& T_target_frame) {
  const auto& p = request.pose.pose.position;
  const Eigen::Vector3d placed = T_target_frame * Eigen::Vector3d(p.x, p.y, p.z);
  if (std::all_of(placed.begin(), placed.end(), isComposable)) return std::nullopt;
  return Rejection{Response::NOT_FINITE,
                   "found an infinite or huge number in the pose after tf, expected finite ones"};
}

}  // namespace pcrb
