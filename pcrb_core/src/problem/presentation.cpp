#include "pcrb_core/problem/presentation.hpp"

#include "pcrb_core/error.hpp"

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

Presentation presentForRegistration(const Transform& P) { return {P, Transform::Identity()}; }

Presentation presentForLocalization(const Transform& P, const Transform& V) {
  return {V.inverse(), P * V};
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
