#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace pcrb {

/// A point of the tree and its squared distance from the query.
struct Neighbor {
  std::uint32_t index = 0;        ///< into the tree's points
  float squared_distance = 0.0F;  ///< m²
};

/// Exact nearest neighbours among points in 3D. Searches are const, and safe in any number of
/// threads.
class KdTree {
 public:
  /// @param points  finite, kept as a copy.
  /// @throws InvalidProblem  if there are no points.
  explicit KdTree(std::vector<Eigen::Vector3f> points);
  ~KdTree();
  KdTree(KdTree&&) noexcept;
  KdTree& operator=(KdTree&&) noexcept;

  const std::vector<Eigen::Vector3f>& points() const;

  /// The nearest point.
  Neighbor nearest(const Eigen::Vector3f& query) const;

  /// The up to `count` nearest points, nearest first.
  ///
  /// @param neighbors  its size becomes min(count, number of points).
  void nearest(const Eigen::Vector3f& query, std::size_t count,
               std::vector<Neighbor>& neighbors) const;

  /// All points closer than `radius` (m), in no particular but always the same order.
  void within(const Eigen::Vector3f& query, float radius, std::vector<Neighbor>& neighbors) const;

 private:
  struct Index;
  std::unique_ptr<Index> index_;
};

}  // namespace pcrb
