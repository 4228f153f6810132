#include "pcrb_core/problem/presentation.hpp"

#include <numeric>
#include <vector>

#include "pcrb_core/error.hpp"
#include "pcrb_core/random.hpp"

namespace pcrb {

const char* toString(PresentationKind kind) {
  return kind == PresentationKind::kRegistration ? "registration" : "localization";
}

PresentationKind presentationFromString(const std::string& text) {
  if (text == "registration") return PresentationKind::kRegistration;
  if (text == "localization") return PresentationKind::kLocalization;
  throw InvalidParameter("presentation: found `" + text +
                         "`, expected `registration` or `localization`");
}

Presentation presentForRegistration(const Transform& P) {
  Presentation presentation;
  presentation.applied = P;
  return presentation;
}

Presentation presentForLocalization(const Transform& P, const Transform& V) {
  Presentation presentation;
  presentation.applied = V.inverse();
  presentation.guess = P * V;
  return presentation;
}

Presentation moved(const Presentation& presentation, const Transform& A, PresentationKind kind) {
  Presentation moved = presentation;
  moved.target_applied = A;
  if (kind == PresentationKind::kLocalization) {
    moved.guess = A * presentation.guess;
  } else {
    moved.applied = A * presentation.applied;
  }
  return moved;
}

Transform secretTargetMotion(const Secret& secret, const std::string& subject,
                             const Eigen::Vector3d& middle, bool about_z) {
  constexpr double kFarthest = 50.0;  // m
  Transform A = Transform::Identity();
  A.linear() = (about_z ? secret.yaw(subject) : secret.rotation(subject)).toRotationMatrix();
  for (int axis = 0; axis < 3; ++axis) {
    const double u = secret.uniform("shift " + std::to_string(axis), subject);
    A.translation()[axis] = kFarthest * (2.0 * u - 1.0);
  }
  return A * Transform(Eigen::Translation3d(-middle));
}

PointCloud secretPart(const PointCloud& cloud, const Secret& secret, const std::string& subject) {
  std::vector<std::size_t> order(cloud.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  Random(secret.bits("part", subject)).shuffle(order);
  order.resize((cloud.size() * 95 + 99) / 100);
  PointCloud part;
  part.local_origin = cloud.local_origin;
  part.points.reserve(order.size());
  for (const std::size_t i : order) part.points.push_back(cloud.points[i]);
  if (cloud.intensity.empty()) return part;
  for (const std::size_t i : order) part.intensity.push_back(cloud.intensity[i]);
  return part;
}

Transform secretSensorPose(const Secret& secret, const std::string& subject, bool has_viewpoint,
                           const Transform& viewpoint, const Eigen::Vector3d& centroid,
                           bool yaw_only) {
  if (has_viewpoint) return viewpoint * Transform(secret.yaw(subject));
  Transform V = Transform::Identity();
  V.translation() = centroid;
  V.linear() = (yaw_only ? secret.yaw(subject) : secret.rotation(subject)).toRotationMatrix();
  return V;
}

}  // namespace pcrb
