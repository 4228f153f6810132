#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "pcrb_core/transform.hpp"

namespace pcrb_tools::simulation {

constexpr double kPi = 3.141592653589793;

/// What a sensor sees of a surface.
struct Surface {
  Eigen::Vector3f color;  ///< red, green, blue, each in [0, 1]
  float reflectivity;     ///< share of lidar light that comes back at normal incidence, [0, 1]
};

/// Half-line; `direction` is of unit length, all in m.
struct Ray {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;
};

/// Where a ray ends.
struct Hit {
  double distance;         ///< m, from the ray's origin
  Eigen::Vector3d normal;  ///< unit length, outwards
  Surface surface;
};

/// A primitive solid: the unit box, upright unit cylinder or unit sphere, scaled and moved.
struct Shape {
  enum class Kind { kBox, kCylinder, kEllipsoid };

  Kind kind;
  pcrb::Transform T_world_shape;
  Eigen::Vector3d half_size;  ///< m, half the extents along the shape's own axes, > 0
  Surface surface;
};

/// A shape that is ready for many rays: the affine map that makes it a unit solid is kept.
class UnitSolid {
 public:
  explicit UnitSolid(const Shape& shape);

  /// First intersection nearer than `limit` m in front of the ray's origin. A ray from the inside
  /// sees nothing: sensors stand outside.
  std::optional<Hit> intersect(const Ray& ray, double limit) const;

  /// Axis-aligned bounds in the world, m.
  const Eigen::AlignedBox3d& bounds() const { return bounds_; }

 private:
  Shape::Kind kind_;
  Eigen::Matrix3d to_unit_;         ///< linear part of world → unit solid
  Eigen::Vector3d to_unit_offset_;  ///< and its translation
  Eigen::AlignedBox3d bounds_;
  Surface surface_;
};

}  // namespace pcrb_tools::simulation
