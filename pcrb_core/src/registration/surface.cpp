#include "registration/surface.hpp"

#include <Eigen/Eigenvalues>

#include "registration/blocks.hpp"

namespace pcrb {
namespace {

constexpr std::size_t kMinNeighbors = 3;

Eigen::Vector3f normalOf(const Points& points, const std::vector<Neighbor>& neighbors) {
  const Eigen::Vector3d reference = points[neighbors.front().index].cast<double>();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const auto& neighbor : neighbors) {
    const Eigen::Vector3d offset = points[neighbor.index].cast<double>() - reference;
    sum += offset;
    squares += offset * offset.transpose();
  }
  const double n = static_cast<double>(neighbors.size());
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(squares - sum * sum.transpose() / n);
  return solver.eigenvectors().col(0).cast<float>();
}

template <class Search>
Points normalsOf(const KdTree& tree, int threads, const Search& search) {
  const Points& points = tree.points();
  Points normals(points.size(), Eigen::Vector3f::Zero());
  forBlocks(points.size(), threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> found;
    for (std::size_t i = begin; i < end; ++i) {
      search(points[i], found);
      if (found.size() >= kMinNeighbors) normals[i] = normalOf(points, found);
    }
  });
  return normals;
}

}  // namespace

Points surfaceNormals(const KdTree& tree, std::size_t neighbors, int threads) {
  return normalsOf(tree, threads, [&](const Eigen::Vector3f& point, std::vector<Neighbor>& found) {
    tree.nearest(point, neighbors, found);
  });
}

Points surfaceNormalsWithin(const KdTree& tree, double radius, int threads) {
  return normalsOf(tree, threads, [&](const Eigen::Vector3f& point, std::vector<Neighbor>& found) {
    tree.within(point, static_cast<float>(radius), found);
  });
}

}  // namespace pcrb
