#include "pcrb_core/registration/registration.hpp"

#include <chrono>
#include <sstream>

namespace pcrb {
namespace {

void requireFinite(const PointCloud& cloud, const char* what) {
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!cloud.points[i].allFinite()) {
      throw InvalidProblem(std::string(what) + ": found point " + std::to_string(i) +
                           " not finite, expected finite points only");
    }
  }
  if (cloud.size() == 0) {
    throw InvalidProblem(std::string(what) + ": found no points, expected at least one");
  }
}

void requireGuess(const Transform& T) {
  try {
    requireRigid(T.matrix().topRows<3>());
  } catch (const InvalidProblem& error) {
    throw InvalidProblem(std::string("initial guess: ") + error.what());
  }
}

// Rounding to whole metres keeps the subtraction exact for most coordinates.
Eigen::Vector3d roundedCentroid(const PointCloud& cloud) { return centroid(cloud).array().round(); }

PointCloud moved(const PointCloud& cloud, const Eigen::Vector3d& origin) {
  PointCloud result;
  result.intensity = cloud.intensity;
  result.local_origin = cloud.local_origin + origin;
  result.points.reserve(cloud.size());
  for (const auto& point : cloud.points) {
    result.points.emplace_back((point.cast<double>() - origin).cast<float>());
  }
  return result;
}

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

void Registration::setTarget(const std::shared_ptr<const PointCloud>& target) {
  has_target_ = false;
  if (target == nullptr) throw InvalidProblem("target: found none, expected a cloud");
  requireFinite(*target, "target");
  local_origin_ = target->local_origin;
  working_origin_ = roundedCentroid(*target);
  prepareTarget(moved(*target, working_origin_));
  has_target_ = true;
}

RegistrationResult Registration::align(const PointCloud& source,
                                       const Transform& T_target_source_guess) {
  const auto start = std::chrono::steady_clock::now();
  if (!has_target_) throw InvalidProblem("target: found none, expected setTarget() before align()");
  requireFinite(source, "source");
  requireGuess(T_target_source_guess);
  if (source.local_origin != local_origin_) {
    std::ostringstream message;
    message << "source: found local origin (" << source.local_origin.transpose()
            << "), expected the target's (" << local_origin_.transpose() << ")";
    throw InvalidProblem(message.str());
  }
  RegistrationResult result = alignSource(moved(source, working_origin_),
                                          inLocalFrame(T_target_source_guess, working_origin_));
  if (result.covariance) {
    // Of the position of another frame: that of the target as given, seen from the working origin.
    result.covariance = mountedCovariance(*result.covariance, result.T_target_source,
                                          Transform(Eigen::Translation3d(-working_origin_)));
  }
  result.T_target_source = inLocalFrame(result.T_target_source, -working_origin_);
  try {
    requireRigid(result.T_target_source.matrix().topRows<3>());
  } catch (const InvalidProblem& error) {
    throw RegistrationFailed(std::string("the method's result: ") + error.what());
  }
  result.solver_time = secondsSince(start);
  return result;
}

}  // namespace pcrb
