#include "pcrb_core/run/scoring.hpp"

#include <algorithm>
#include <cmath>

#include "pcrb_core/run/results_store.hpp"

namespace pcrb {

namespace {

constexpr double kUnitQuaternionTolerance = 1e-3;
constexpr double kLargestNumber = 1e100;  // beyond it, composing transforms may overflow

bool isComposable(double number) { return std::abs(number) <= kLargestNumber; }

bool areComposable(const double* numbers, std::size_t count) {
  return std::all_of(numbers, numbers + count, isComposable);
}

Defect notFinite(const std::string& message) { return {Defect::Kind::kNotFinite, message}; }

std::optional<Defect> checkPose(const Eigen::Vector3d& position,
                                const Eigen::Quaterniond& orientation,
                                const PoseCovariance& covariance) {
  const Eigen::Vector4d q = orientation.coeffs();
  if (!areComposable(position.data(), 3) || !areComposable(q.data(), 4) ||
      !areComposable(covariance.data(), covariance.size())) {
    return notFinite("found a NaN, infinite or huge number in the pose, expected finite ones");
  }
  const double norm = std::sqrt(q.x() * q.x() + q.y() * q.y() + q.z() * q.z() + q.w() * q.w());
  if (std::abs(norm - 1.0) <= kUnitQuaternionTolerance) return std::nullopt;
  return Defect{Defect::Kind::kNotUnitQuaternion,
                "found a quaternion of norm " + std::to_string(norm) + ", expected 1"};
}

bool isTime(double seconds) { return seconds >= 0.0 && std::isfinite(seconds); }

/// In order, so that each has a row of its own, and with poses that can be scored.
std::optional<Defect> checkScans(const std::vector<ScanRecord>& scans) {
  std::uint32_t last = 0;
  for (const ScanRecord& record : scans) {
    const std::string which = "scans[" + std::to_string(&record - scans.data()) + "]: ";
    if (record.scan <= last) return notFinite(which + "expected numbers from 1 that increase");
    last = record.scan;
    if (!isTime(record.sent) || !isTime(record.answered.value_or(0.0))) {
      return notFinite(which + "found a time that is none, expected 0 or more");
    }
    if (!record.position) continue;
    auto defect = checkPose(*record.position, *record.orientation, PoseCovariance{});
    if (defect) return Defect{defect->kind, which + defect->message};
  }
  return std::nullopt;
}

/// Scans with the poses of their answers in the target's frame.
std::vector<ScanRecord> placedScans(std::vector<ScanRecord> scans,
                                    const std::optional<Transform>& T_target_frame) {
  for (ScanRecord& record : scans) {
    if (!record.position) continue;
    record.orientation->normalize();
    if (!T_target_frame) continue;
    *record.position = *T_target_frame * *record.position;
    *record.orientation =
        (Eigen::Quaterniond(T_target_frame->linear()) * *record.orientation).normalized();
  }
  return scans;
}

Outcome outcomeOf(Submission::Status status) {
  if (status == Submission::Status::kPose) return Outcome::kReplied;
  return status == Submission::Status::kFailed ? Outcome::kFailed : Outcome::kTimedOut;
}

void placePose(const Submission& submission, const std::optional<Transform>& T_target_frame,
               Reply& reply) {
  reply.position = submission.position;
  reply.orientation = submission.orientation.normalized();
  reply.covariance = submission.covariance;
  if (!T_target_frame) return;
  const Eigen::Matrix3d R = T_target_frame->linear();
  reply.position = *T_target_frame * reply.position;
  reply.orientation = (Eigen::Quaterniond(R) * reply.orientation).normalized();
  if (reply.covariance) reply.covariance = rotatedCovariance(*reply.covariance, R);
}

void setError(const PoseError& error, Result& result) {
  result.error = error.error;
  result.rotation_error = error.rotation_error;
  result.translation_error = error.translation_error;
}

}  // namespace

std::optional<Defect> checkSubmission(const Submission& submission) {
  const double solver_time = submission.solver_time.value_or(0.0);
  if (!isTime(solver_time)) {
    return notFinite("found solver_time " + std::to_string(solver_time) +
                     ", expected 0 or more, or NaN for unknown");
  }
  if (!isTime(submission.cpu_time)) {
    return notFinite("found cpu_time " + std::to_string(submission.cpu_time) +
                     ", expected 0 or more, 0 for unknown");
  }
  if (auto defect = checkScans(submission.scans)) return defect;
  if (submission.status != Submission::Status::kPose) return std::nullopt;
  return checkPose(submission.position, submission.orientation,
                   submission.covariance.value_or(PoseCovariance{}));
}

std::optional<Defect> checkPlaced(const Submission& submission, const Transform& T_target_frame) {
  const Eigen::Vector3d placed = T_target_frame * submission.position;
  if (areComposable(placed.data(), 3)) return std::nullopt;
  return notFinite("found an infinite or huge number in the pose after tf, expected finite ones");
}

Reply makeReply(const Submission& submission, const std::optional<Transform>& T_target_frame) {
  Reply reply;
  reply.outcome = outcomeOf(submission.status);
  reply.reason = submission.reason;
  reply.solver_time = submission.solver_time;
  if (submission.scans_used > 0) reply.scans_used = submission.scans_used;
  reply.cpu_time = submission.cpu_time;
  reply.peak_memory = submission.peak_memory;
  reply.scans = placedScans(submission.scans, T_target_frame);
  if (reply.outcome == Outcome::kReplied) {
    placePose(submission, T_target_frame, reply);
  } else if (reply.reason.empty()) {
    reply.reason = "the client gave no reason";
  }
  return reply;
}

Result score(const PosedProblem& posed, const Reply& reply) {
  const PlannedProblem& planned = *posed.planned;
  Result result;
  result.key = planned.key;
  result.source = planned.problem.source;
  result.target = planned.problem.target;
  result.overlap = planned.problem.overlap;
  result.outcome = reply.outcome;
  result.reason = reply.reason;
  result.initial_misalignment = posed.initial.error;
  setError(posed.initial, result);  // of the initial guess: what a problem without a reply gets
  if (reply.outcome == Outcome::kReplied) {
    result.position = reply.position;
    result.orientation = reply.orientation;
    result.covariance = reply.covariance;
    const Transform T = makeTransform(reply.position, reply.orientation);
    setError(posed.source->metric->evaluate(posed.presentation.residual(T)), result);
  }
  result.scans = reply.scans;
  for (ScanRecord& record : result.scans) {
    if (!record.position) continue;
    const Transform T = makeTransform(*record.position, *record.orientation);
    record.error = posed.source->metric->evaluate(posed.presentation.residual(T)).error;
  }
  result.runtime = reply.runtime;
  result.solver_time = reply.solver_time;
  result.scans_used = reply.scans_used;
  result.target_changed = planned.target_changed;
  result.replies_rejected = reply.rejected;
  result.finished = secondsSinceEpoch();
  return result;
}

Transform scoredPose(const PosedProblem& posed, const Result& result) {
  return result.position && result.orientation
             ? makeTransform(*result.position, *result.orientation)
             : posed.presentation.guess;
}

}  // namespace pcrb
