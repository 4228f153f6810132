#include "pcrb_core/registration/preprocessing.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "pcrb_core/error.hpp"
#include "pcrb_core/parallel.hpp"
#include "pcrb_core/random.hpp"

namespace pcrb {
namespace {

constexpr int kBitsPerAxis = 21;

struct Keyed {
  std::uint64_t cell;
  std::uint32_t index;
};

Eigen::Array3d lowestCell(const Points& points, double inverse_leaf) {
  Eigen::AlignedBox3f box;
  for (const auto& point : points) box.extend(point);
  const Eigen::Array3d low = (box.min().cast<double>().array() * inverse_leaf).floor();
  const Eigen::Array3d high = (box.max().cast<double>().array() * inverse_leaf).floor();
  if (!((high - low).maxCoeff() < std::ldexp(1.0, kBitsPerAxis))) {
    throw InvalidProblem("voxel grid: found a cloud of " + std::to_string(box.sizes().maxCoeff()) +
                         " m and a leaf of " + std::to_string(1.0 / inverse_leaf) +
                         " m, expected at most 2^21 cells along an axis");
  }
  return low;
}

std::vector<Keyed> cells(const Points& points, double leaf) {
  const double inverse_leaf = 1.0 / leaf;
  const Eigen::Array3d low = lowestCell(points, inverse_leaf);
  std::vector<Keyed> keyed;
  keyed.reserve(points.size());
  for (const auto& point : points) {
    const Eigen::Array3d cell = (point.cast<double>().array() * inverse_leaf).floor() - low;
    const auto key = (static_cast<std::uint64_t>(cell.z()) << (2 * kBitsPerAxis)) |
                     (static_cast<std::uint64_t>(cell.y()) << kBitsPerAxis) |
                     static_cast<std::uint64_t>(cell.x());
    keyed.push_back({key, static_cast<std::uint32_t>(keyed.size())});
  }
  return keyed;
}

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

Points voxelGrid(const Points& points, double leaf) {
  if (points.empty()) return {};
  std::vector<Keyed> keyed = cells(points, leaf);
  std::sort(keyed.begin(), keyed.end(), [](const Keyed& a, const Keyed& b) {
    return a.cell < b.cell || (a.cell == b.cell && a.index < b.index);
  });
  Points means;
  for (std::size_t begin = 0; begin < keyed.size();) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    std::size_t end = begin;
    for (; end < keyed.size() && keyed[end].cell == keyed[begin].cell; ++end) {
      sum += points[keyed[end].index].cast<double>();
    }
    means.emplace_back((sum / static_cast<double>(end - begin)).cast<float>());
    begin = end;
  }
  return means;
}

Points subsample(const Points& points, double fraction, std::uint64_t seed) {
  std::size_t needed =
      static_cast<std::size_t>(std::llround(fraction * static_cast<double>(points.size())));
  Random random(seed);
  Points kept;
  kept.reserve(needed);
  for (std::size_t i = 0; i < points.size() && needed > 0; ++i) {
    if (random.below(points.size() - i) < needed) {
      kept.push_back(points[i]);
      --needed;
    }
  }
  return kept;
}

Eigen::Vector3d meanOf(const Points& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& point : points) sum += point.cast<double>();
  return sum / static_cast<double>(points.size());
}

void requirePoints(const Points& points, std::size_t min, const char* what) {
  if (points.size() >= min) return;
  throw InvalidProblem(std::string(what) + ": found " + std::to_string(points.size()) +
                       " points after filtering, expected at least " + std::to_string(min));
}

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
