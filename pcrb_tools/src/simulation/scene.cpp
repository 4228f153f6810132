#include "simulation/scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pcrb_tools::simulation {
namespace {

/// Whether a ray passes a ball closer than its radius.
bool passesNear(const Ray& ray, const Eigen::Vector3d& center, double radius) {
  const Eigen::Vector3d to_center = center - ray.origin;
  const double along = to_center.dot(ray.direction);
  return along > -radius && to_center.squaredNorm() - along * along < radius * radius;
}

}  // namespace

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
