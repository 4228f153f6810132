#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <vector>

#include "pcrb_core/point_cloud.hpp"
#include "pcrb_core/random.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb_test {

/// A random rotation by an angle (rad) and a translation of a length (m), about the origin.
inline pcrb::Transform randomMotion(pcrb::Random& random, double angle, double length) {
  const Eigen::Quaterniond rotation(Eigen::AngleAxisd(angle, random.direction()));
  return pcrb::makeTransform(random.direction() * length, rotation);
}

/// Points on the rectangle that two edges span, with noise of up to ± `noise` m along all axes.
inline void addRectangle(pcrb::PointCloud& cloud, pcrb::Random& random, std::size_t count,
                         const Eigen::Vector3d& corner, const Eigen::Vector3d& u,
                         const Eigen::Vector3d& v, double noise) {
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::Vector3d point = corner + random.uniform() * u;
    point += random.uniform() * v;  // one draw a statement: the order in an expression is open
    for (int k = 0; k < 3; ++k) point[k] += noise * random.uniform(-1.0, 1.0);
    cloud.points.push_back(point.cast<float>());
  }
}

inline void addBox(pcrb::PointCloud& cloud, pcrb::Random& random, std::size_t count,
                   const Eigen::Vector3d& corner, const Eigen::Vector3d& size, double noise) {
  const Eigen::Vector3d x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, size.z());
  addRectangle(cloud, random, count, corner, x, z, noise);
  addRectangle(cloud, random, count, corner, y, z, noise);
  addRectangle(cloud, random, count, corner + x, y, z, noise);
  addRectangle(cloud, random, count, corner + y, x, z, noise);
  addRectangle(cloud, random, count, corner + z, x, y, noise);
}

/// A hall of 16 × 10 × 4 m, two walls open, with boxes of different sizes: about 14,000 points,
/// another sample of the same surfaces for every seed.
inline pcrb::PointCloud hall(std::uint64_t seed) {
  constexpr double kNoise = 0.01;
  pcrb::Random random(seed);
  pcrb::PointCloud cloud;
  addRectangle(cloud, random, 4000, {-8, -5, 0}, {16, 0, 0}, {0, 10, 0}, kNoise);
  addRectangle(cloud, random, 1600, {-8, -5, 0}, {16, 0, 0}, {0, 0, 4}, kNoise);
  addRectangle(cloud, random, 1000, {-8, -5, 0}, {0, 10, 0}, {0, 0, 4}, kNoise);
  addBox(cloud, random, 350, {-6, -3, 0}, {2, 1, 1.5}, kNoise);
  addBox(cloud, random, 300, {1, -4, 0}, {1, 1.5, 2.5}, kNoise);
  addBox(cloud, random, 350, {4, 1, 0}, {3, 2, 1}, kNoise);
  addBox(cloud, random, 220, {-3, 2, 0}, {0.8, 0.8, 3}, kNoise);
  addBox(cloud, random, 180, {-7, 3.5, 0}, {1.2, 0.6, 0.8}, kNoise);
  addBox(cloud, random, 180, {6.5, -4.5, 1}, {0.7, 0.9, 1.6}, kNoise);
  return cloud;
}

/// A floor of 16 × 10 m and nothing else.
inline pcrb::PointCloud plane(std::uint64_t seed) {
  pcrb::Random random(seed);
  pcrb::PointCloud cloud;
  addRectangle(cloud, random, 5000, {-8, -5, 0}, {16, 0, 0}, {0, 10, 0}, 0.0);
  return cloud;
}

inline pcrb::PointCloud transformed(const pcrb::PointCloud& cloud, const pcrb::Transform& T) {
  pcrb::PointCloud result = cloud;
  for (auto& point : result.points) point = (T * point.cast<double>()).cast<float>();
  return result;
}

inline std::shared_ptr<const pcrb::PointCloud> shared(pcrb::PointCloud cloud) {
  return std::make_shared<const pcrb::PointCloud>(std::move(cloud));
}

}  // namespace pcrb_test
