#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "pcrb_core/transform.hpp"
#include "simulation/height_field.hpp"
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

/// Pose over time: T_world_body at a time in s since the start of the log.
using Motion = std::function<pcrb::Transform(double time)>;

/// Something that moves as one: its shapes stand in its own frame.
struct Body {
  std::vector<Shape> shapes;
  Motion T_world_body;
};

/// A scene as data: what stands still, what moves, and the ground where it is not flat.
struct SceneDescription {
  std::vector<Shape> shapes;
  std::vector<Body> bodies;
  std::optional<HeightField> ground;
};

/// A scene that rays can be cast into. Immutable: any number of threads may use it at once.
class Scene {
 public:
  explicit Scene(const SceneDescription& description);

  /// The scene at one moment; it must not outlive the scene.
  class Snapshot {
   public:
    /// First surface nearer than `limit` m.
    std::optional<Hit> cast(const Ray& ray, double limit) const;

   private:
    friend class Scene;
    explicit Snapshot(const Scene& scene) : scene_(scene) {}

    const Scene& scene_;
    std::vector<pcrb::Transform> T_body_world_;
  };

  /// @param time  s since the start of the log.
  Snapshot at(double time) const;

  /// Height of the ground in m; 0 where it is flat.
  double groundHeight(double x, double y) const;

 private:
  struct MovingSolids {
    Bvh solids;
    Eigen::Vector3d center;  ///< of the ball around all of them, in the body's frame
    double radius;
    Motion T_world_body;
  };

  Bvh still_;
  std::optional<HeightField> ground_;
  std::vector<MovingSolids> moving_;
};

}  // namespace pcrb_tools::simulation
