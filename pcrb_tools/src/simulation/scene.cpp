#include "simulation/scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace pcrb_tools::simulation {
namespace {

constexpr std::uint32_t kLeafSize = 3;
/// Median splits halve a node, so that a depth of 64 is never reached.
constexpr std::size_t kMaxDepth = 64;

/// Whether a ray enters a box before `limit`, by the slabs of its three axes.
bool meets(const Eigen::AlignedBox3d& box, const Eigen::Array3d& origin,
           const Eigen::Array3d& inverse_direction, double limit) {
  const Eigen::Array3d low = (box.min().array() - origin) * inverse_direction;
  const Eigen::Array3d high = (box.max().array() - origin) * inverse_direction;
  const double enter = low.min(high).maxCoeff();
  const double leave = low.max(high).minCoeff();
  return enter <= leave && leave > 0.0 && enter < limit;
}

/// Whether a ray passes a ball closer than its radius.
bool passesNear(const Ray& ray, const Eigen::Vector3d& center, double radius) {
  const Eigen::Vector3d to_center = center - ray.origin;
  const double along = to_center.dot(ray.direction);
  return along > -radius && to_center.squaredNorm() - along * along < radius * radius;
}

}  // namespace

Bvh::Bvh(const std::vector<Shape>& shapes) {
  solids_.reserve(shapes.size());
  for (const Shape& shape : shapes) solids_.emplace_back(shape);
  if (!solids_.empty()) build(0, static_cast<std::uint32_t>(solids_.size()));
}

void Bvh::build(std::uint32_t begin, std::uint32_t end) {
  const std::size_t index = nodes_.size();
  nodes_.emplace_back();
  Eigen::AlignedBox3d bounds;
  for (std::uint32_t i = begin; i < end; ++i) bounds.extend(solids_[i].bounds());
  nodes_[index].bounds = bounds;
  if (end - begin <= kLeafSize) {
    nodes_[index].first = begin;
    nodes_[index].count = end - begin;
    return;
  }
  int axis = 0;
  bounds.sizes().maxCoeff(&axis);
  const std::uint32_t middle = begin + (end - begin) / 2;
  const auto first = solids_.begin();
  std::nth_element(first + begin, first + middle, first + end,
                   [axis](const UnitSolid& a, const UnitSolid& b) {
                     return a.bounds().center()[axis] < b.bounds().center()[axis];
                   });
  build(begin, middle);
  nodes_[index].first = static_cast<std::uint32_t>(nodes_.size());
  build(middle, end);
}

std::optional<Hit> Bvh::intersect(const Ray& ray, double limit) const {
  std::optional<Hit> nearest;
  if (nodes_.empty()) return nearest;
  const Eigen::Array3d origin = ray.origin.array();
  const Eigen::Array3d inverse_direction = ray.direction.array().inverse();
  std::array<std::uint32_t, kMaxDepth> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t index = stack[--depth];
    const Node& node = nodes_[index];
    if (!meets(node.bounds, origin, inverse_direction, limit)) continue;
    if (node.count == 0) {
      stack[depth++] = node.first;
      stack[depth++] = index + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (const std::optional<Hit> hit = solids_[i].intersect(ray, limit)) {
        nearest = hit;
        limit = hit->distance;
      }
    }
  }
  return nearest;
}

Scene::Scene(const SceneDescription& description)
    : still_(description.shapes), ground_(description.ground) {
  for (const Body& body : description.bodies) {
    Eigen::AlignedBox3d bounds;
    for (const Shape& shape : body.shapes) bounds.extend(UnitSolid(shape).bounds());
    moving_.push_back(
        {Bvh(body.shapes), bounds.center(), 0.5 * bounds.diagonal().norm(), body.T_world_body});
  }
}

Scene::Snapshot Scene::at(double time) const {
  Snapshot snapshot(*this);
  for (const MovingSolids& body : moving_) {
    snapshot.T_body_world_.push_back(body.T_world_body(time).inverse());
  }
  return snapshot;
}

double Scene::groundHeight(double x, double y) const {
  return ground_ ? ground_->height(x, y) : 0.0;
}

std::optional<Hit> Scene::Snapshot::cast(const Ray& ray, double limit) const {
  std::optional<Hit> nearest;
  const auto keep = [&](std::optional<Hit> hit) {
    if (!hit) return;
    nearest = hit;
    limit = hit->distance;
  };
  if (scene_.ground_) keep(scene_.ground_->intersect(ray, limit));
  keep(scene_.still_.intersect(ray, limit));
  for (std::size_t i = 0; i < scene_.moving_.size(); ++i) {
    const MovingSolids& body = scene_.moving_[i];
    const pcrb::Transform& T_body_world = T_body_world_[i];
    const Ray local{T_body_world * ray.origin, T_body_world.linear() * ray.direction};
    if (!passesNear(local, body.center, body.radius)) continue;
    std::optional<Hit> hit = body.solids.intersect(local, limit);
    if (hit) hit->normal = T_body_world.linear().transpose() * hit->normal;
    keep(hit);
  }
  return nearest;
}

}  // namespace pcrb_tools::simulation
