#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "simulation/shape.hpp"

namespace pcrb_tools::simulation {

/// Bounding volume hierarchy over solids: finds the first one that a ray meets.
class Bvh {
 public:
  explicit Bvh(const std::vector<Shape>& shapes);

  /// First intersection nearer than `limit` m.
  std::optional<Hit> intersect(const Ray& ray, double limit) const;

 private:
  /// A leaf has solids [first, first + count); an inner node (count 0) has its children at its own
  /// index + 1 and at `first`.
  struct Node {
    Eigen::AlignedBox3d bounds;
    std::uint32_t first = 0;
    std::uint32_t count = 0;
  };

  void build(std::uint32_t begin, std::uint32_t end);

  std::vector<UnitSolid> solids_;
  std::vector<Node> nodes_;
};

}  // namespace pcrb_tools::simulation
