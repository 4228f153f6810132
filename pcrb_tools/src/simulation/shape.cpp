#include "simulation/shape.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace pcrb_tools::simulation {
namespace {

using Eigen::Vector3d;

/// Where a line enters a unit solid: its parameter and the normal there, both in the unit frame.
struct Entry {
  double parameter;
  Vector3d normal;
};

std::optional<Entry> enterBox(const Vector3d& origin, const Vector3d& direction) {
  double enter = -std::numeric_limits<double>::infinity();
  double leave = std::numeric_limits<double>::infinity();
  int entered_axis = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double inverse = 1.0 / direction[axis];
    double near = (-1.0 - origin[axis]) * inverse;
    double far = (1.0 - origin[axis]) * inverse;
    if (near > far) std::swap(near, far);
    if (near > enter) {
      enter = near;
      entered_axis = axis;
    }
    leave = std::min(leave, far);
  }
  if (!(enter <= leave)) return std::nullopt;
  Vector3d normal = Vector3d::Zero();
  normal[entered_axis] = direction[entered_axis] > 0.0 ? -1.0 : 1.0;
  return Entry{enter, normal};
}

/// Smaller root of a t² + 2 b t + c, if there is one.
std::optional<double> smallerRoot(double a, double b, double c) {
  const double discriminant = b * b - a * c;
  if (discriminant < 0.0 || a == 0.0) return std::nullopt;
  return (-b - std::sqrt(discriminant)) / a;
}

std::optional<Entry> enterSphere(const Vector3d& origin, const Vector3d& direction) {
  const auto t =
      smallerRoot(direction.squaredNorm(), origin.dot(direction), origin.squaredNorm() - 1.0);
  if (!t) return std::nullopt;
  return Entry{*t, origin + *t * direction};
}

std::optional<Entry> enterCylinder(const Vector3d& origin, const Vector3d& direction) {
  const double cap = direction.z() > 0.0 ? -1.0 : 1.0;
  const double t_cap = (cap - origin.z()) / direction.z();
  const Vector3d at_cap = origin + t_cap * direction;
  if (std::isfinite(t_cap) && at_cap.head<2>().squaredNorm() <= 1.0) {
    return Entry{t_cap, Vector3d(0.0, 0.0, cap)};
  }
  const auto t =
      smallerRoot(direction.head<2>().squaredNorm(), origin.head<2>().dot(direction.head<2>()),
                  origin.head<2>().squaredNorm() - 1.0);
  if (!t) return std::nullopt;
  const Vector3d at_side = origin + *t * direction;
  if (std::abs(at_side.z()) > 1.0) return std::nullopt;
  return Entry{*t, Vector3d(at_side.x(), at_side.y(), 0.0)};
}

std::optional<Entry> enter(Shape::Kind kind, const Vector3d& origin, const Vector3d& direction) {
  switch (kind) {
    case Shape::Kind::kBox:
      return enterBox(origin, direction);
    case Shape::Kind::kCylinder:
      return enterCylinder(origin, direction);
    case Shape::Kind::kEllipsoid:
      return enterSphere(origin, direction);
  }
  return std::nullopt;
}

/// Bounds of the box around a shape; tight for boxes, a little loose for the round ones.
Eigen::AlignedBox3d boundsOf(const Shape& shape) {
  const Vector3d reach = shape.T_world_shape.linear().cwiseAbs() * shape.half_size;
  const Vector3d center = shape.T_world_shape.translation();
  return {center - reach, center + reach};
}

}  // namespace

UnitSolid::UnitSolid(const Shape& shape)
    : kind_(shape.kind),
      to_unit_(shape.half_size.cwiseInverse().asDiagonal() *
               shape.T_world_shape.linear().transpose()),
      to_unit_offset_(-to_unit_ * shape.T_world_shape.translation()),
      bounds_(boundsOf(shape)),
      surface_(shape.surface) {}

std::optional<Hit> UnitSolid::intersect(const Ray& ray, double limit) const {
  // An affine map keeps the ray's parameter: the distance in the world comes out directly.
  const Vector3d origin = to_unit_ * ray.origin + to_unit_offset_;
  const Vector3d direction = to_unit_ * ray.direction;
  const std::optional<Entry> entry = enter(kind_, origin, direction);
  if (!entry || entry->parameter <= 0.0 || entry->parameter >= limit) return std::nullopt;
  return Hit{entry->parameter, (to_unit_.transpose() * entry->normal).normalized(), surface_};
}

}  // namespace pcrb_tools::simulation
