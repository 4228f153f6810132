#include "pcrb_core/problem/perturbation.hpp"

#include <sstream>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

/// The published bounds are bounds of what was sampled; centroids of re-converted clouds differ a
/// little (DESIGN §4).
constexpr double kFrameFactor = 1.1;
constexpr double kFrameSlack = 0.2;

}  // namespace

Transform makePerturbation(const Eigen::Vector3d& center, const Eigen::Vector3d& translation,
                           const Eigen::Matrix3d& rotation) {
  Transform P = Transform::Identity();
  P.linear() = rotation;
  P.translation() = translation - (rotation - Eigen::Matrix3d::Identity()) * center;
  return P;
}

double maxCentroidMotion(const PerturbationBounds& bounds) {
  return bounds.translation.max * kFrameFactor + kFrameSlack;
}

void checkFrame(const Transform& P, const Eigen::Vector3d& source_centroid,
                const PerturbationBounds& bounds) {
  const Eigen::Vector3d motion =
      (P.linear() - Eigen::Matrix3d::Identity()) * source_centroid + P.translation();
  if (motion.norm() <= maxCentroidMotion(bounds)) return;
  std::ostringstream message;
  message << "found a perturbation that moves the source's centroid (" << source_centroid.x() << ' '
          << source_centroid.y() << ' ' << source_centroid.z() << ") by " << motion.norm()
          << " m, expected at most " << maxCentroidMotion(bounds)
          << " m: the clouds are in another frame than the problem file's (check_dataset estimates "
             "the offset between the two)";
  throw InvalidProblem(message.str());
}

}  // namespace pcrb
