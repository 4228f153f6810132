#include "registration/surface.hpp"

#include <Eigen/Eigenvalues>

#include "registration/blocks.hpp"

namespace pcrb {
namespace {

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

}  // namespace

Points surfaceNormals(const KdTree& tree, std::size_t neighbors, int threads) {
  const Points& points = tree.points();
  Points normals(points.size());
  forBlocks(points.size(), threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> nearest;
    for (std::size_t i = begin; i < end; ++i) {
      tree.nearest(points[i], neighbors, nearest);
      normals[i] = normalOf(points, nearest);
    }
  });
  return normals;
}

}  // namespace pcrb
