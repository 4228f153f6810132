#include "simulation/props.hpp"

#include <cmath>

namespace pcrb_tools::simulation {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

Shape makeBox(const Vector3d& center, const Vector3d& size, const Surface& surface, double yaw,
              double tilt) {
  pcrb::Transform pose = atPlace(center, yaw);
  pose.rotate(AngleAxisd(tilt, Vector3d::UnitY()));
  return {Shape::Kind::kBox, pose, 0.5 * size, surface};
}

Shape makeColumn(const Vector3d& foot, double radius, double height, const Surface& surface) {
  return makeRod(foot, foot + height * Vector3d::UnitZ(), radius, surface);
}

Shape makeRod(const Vector3d& from, const Vector3d& to, double radius, const Surface& surface) {
  pcrb::Transform pose = pcrb::Transform::Identity();
  pose.translation() = 0.5 * (from + to);
  pose.linear() =
      Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), to - from).toRotationMatrix();
  return {Shape::Kind::kCylinder, pose, {radius, radius, 0.5 * (to - from).norm()}, surface};
}

Shape makeEllipsoid(const Vector3d& center, const Vector3d& radii, const Surface& surface,
                    double yaw) {
  return {Shape::Kind::kEllipsoid, atPlace(center, yaw), radii, surface};
}

void place(SceneDescription& scene, const Prop& prop, const Vector3d& position, double yaw) {
  const pcrb::Transform T_world_prop = atPlace(position, yaw);
  for (Shape shape : prop) {
    shape.T_world_shape = T_world_prop * shape.T_world_shape;
    scene.shapes.push_back(shape);
  }
}

pcrb::Transform atPlace(const Vector3d& position, double yaw) {
  pcrb::Transform pose = pcrb::Transform::Identity();
  pose.translation() = position;
  pose.linear() = AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix();
  return pose;
}

Motion standAt(const pcrb::Transform& pose) {
  return [pose](double) { return pcrb::Transform(pose); };
}

Motion walkBetween(const Vector3d& a, const Vector3d& b, double speed, double start_time) {
  const double leg = (b - a).norm() / speed;
  const double yaw = std::atan2(b.y() - a.y(), b.x() - a.x());
  return [a, b, leg, yaw, start_time](double time) {
    const double legs = (time + start_time) / leg;
    const double number = std::floor(legs);
    const bool back = std::fmod(number, 2.0) != 0.0;
    const double share = back ? 1.0 - (legs - number) : legs - number;
    return atPlace(a + share * (b - a), back ? yaw + kPi : yaw);
  };
}

}  // namespace pcrb_tools::simulation
