#include "server/replies.hpp"

#include <ros/names.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string_view>
#include <thread>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/text.hpp"
#include "pcrb_server/message_conversion.hpp"

namespace pcrb {

namespace {

using Request = pcrb_msgs::SubmitPose::Request;
using Response = pcrb_msgs::SubmitPose::Response;

constexpr std::size_t kLongestNodeName = 255;
constexpr std::size_t kLongestReason = 4096;  // bytes
constexpr auto kPatience = std::chrono::milliseconds(500);
constexpr auto kPeriod = std::chrono::milliseconds(5);
constexpr int kMaxWaiting = 2;

std::vector<ScanRecord> toScans(const std::vector<pcrb_msgs::ScanReply>& replies) {
  std::vector<ScanRecord> scans;
  for (const auto& reply : replies) {
    ScanRecord& record = scans.emplace_back();
    record.scan = reply.scan;
    record.sent = reply.sent;
    record.is_echo = reply.is_echo != 0;
    if (std::isnan(reply.answered)) continue;
    const auto& p = reply.pose.position;
    const auto& q = reply.pose.orientation;
    record.answered = reply.answered;
    record.position = Eigen::Vector3d(p.x, p.y, p.z);
    record.orientation = Eigen::Quaterniond(q.w, q.x, q.y, q.z);
  }
  return scans;
}

Submission toSubmission(const Request& request) {
  Submission submission;
  submission.status = static_cast<Submission::Status>(request.status);
  const auto& p = request.pose.pose.position;
  const auto& q = request.pose.pose.orientation;
  submission.position = {p.x, p.y, p.z};
  submission.orientation = Eigen::Quaterniond(q.w, q.x, q.y, q.z);
  if (request.has_covariance != 0) {
    submission.covariance.emplace();
    std::copy(request.covariance.begin(), request.covariance.end(), submission.covariance->begin());
  }
  if (!std::isnan(request.solver_time)) submission.solver_time = request.solver_time;
  submission.scans_used = request.scans_used;
  submission.cpu_time = request.cpu_time;
  submission.peak_memory = request.peak_memory;
  submission.scans = toScans(request.scans);
  submission.reason = printableText(std::string_view(request.reason).substr(0, kLongestReason));
  return submission;
}

}  // namespace

static_assert(static_cast<int>(Submission::Status::kPose) == Request::POSE &&
                  static_cast<int>(Submission::Status::kFailed) == Request::FAILED &&
                  static_cast<int>(Submission::Status::kTimedOut) == Request::TIMED_OUT,
              "the states of a submission are those of SubmitPose.srv");

bool isNodeName(const std::string& name) {
  std::string ignored;
  return name.size() > 1 && name.front() == '/' && name.size() <= kLongestNodeName &&
         ros::names::validate(name, ignored);
}

std::optional<Rejection> toRejection(const std::optional<Defect>& defect) {
  if (!defect) return std::nullopt;
  const bool is_finite = defect->kind == Defect::Kind::kNotUnitQuaternion;
  return Rejection{
      static_cast<std::uint8_t>(is_finite ? Response::NOT_UNIT_QUATERNION : Response::NOT_FINITE),
      defect->message};
}

std::optional<Rejection> readSubmission(const Request& request, Submission& submission) {
  if (request.status > Request::TIMED_OUT) {
    return Rejection{Response::NOT_FINITE,
                     "found status " + std::to_string(request.status) + ", expected 0, 1 or 2"};
  }
  submission = toSubmission(request);
  return toRejection(checkSubmission(submission));
}

TfLookup::TfLookup(std::string target_frame, double keep)
    : target_frame_(std::move(target_frame)), buffer_(ros::Duration(keep)), listener_(buffer_) {}

bool TfLookup::waitFor(const std::string& frame, const ros::Time& stamp) {
  // On the steady clock: tf2's own wait follows ROS time, which may stand still.
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  const bool may_wait = waiting_.fetch_add(1) < kMaxWaiting;
  bool is_found = buffer_.canTransform(target_frame_, frame, stamp);
  while (!is_found && may_wait && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(kPeriod);
    is_found = buffer_.canTransform(target_frame_, frame, stamp);
  }
  --waiting_;
  return is_found;
}

std::optional<Transform> TfLookup::operator()(const std::string& frame, const ros::Time& stamp) {
  if (!waitFor(frame, stamp)) return std::nullopt;
  try {
    return fromMessage(buffer_.lookupTransform(target_frame_, frame, stamp).transform);
  } catch (const tf2::TransformException&) {
    return std::nullopt;  // gone between the check and the look-up
  } catch (const Error&) {
    return std::nullopt;  // an infinite translation, which tf2 takes for one
  }
}

}  // namespace pcrb
