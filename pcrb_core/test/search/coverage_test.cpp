#include "search/coverage.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

using Points = std::vector<Eigen::Vector3d>;

/// All pairs, squared distances in double as a k-d tree computes them.
std::size_t countByForce(const Points& source, const Points& target, double distance) {
  std::size_t count = 0;
  for (const auto& p : source) {
    for (const auto& q : target) {
      const double dx = p.x() - q.x();
      const double dy = p.y() - q.y();
      const double dz = p.z() - q.z();
      if (dx * dx + dy * dy + dz * dz < distance * distance) {
        ++count;
        break;
      }
    }
  }
  return count;
}

std::size_t countByCoverage(const Points& source, const Points& target, double distance) {
  const Eigen::Vector3d origin = target.front();
  const CellGrid target_grid(target, origin, distance);
  return Coverage(target_grid).count(CellGrid(source, origin, distance));
}

class RandomPoints {
 public:
  explicit RandomPoints(std::uint64_t seed) : bits_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(bits_() >> 11) * 0x1.0p-53;
  }

  Points box(std::size_t n, const Eigen::Vector3d& corner, const Eigen::Vector3d& size) {
    Points points;
    for (std::size_t i = 0; i < n; ++i) {
      points.emplace_back(corner.x() + uniform(0, size.x()), corner.y() + uniform(0, size.y()),
                          corner.z() + uniform(0, size.z()));
    }
    return points;
  }

 private:
  std::mt19937_64 bits_;
};

TEST(Coverage, CountsLikeAllPairsAtEveryDensity) {
  RandomPoints random(1);
  for (const double size : {0.3, 1.0, 3.0, 10.0, 100.0}) {
    for (const std::size_t n : {1U, 10U, 300U, 3000U}) {
      const Points target = random.box(n, {0, 0, 0}, {size, size, 0.3 * size});
      const Points source = random.box(2000, {0, 0, 0}, {size, size, 0.3 * size});
      EXPECT_EQ(countByCoverage(source, target, 0.2), countByForce(source, target, 0.2))
          << n << " points in " << size << " m";
    }
  }
}

TEST(Coverage, CountsLikeAllPairsAtUtmCoordinates) {
  RandomPoints random(2);
  const Eigen::Vector3d corner(702000.123, 8045000.456, -30.7);
  const Points target = random.box(3000, corner, {6, 6, 2});
  const Points source = random.box(3000, corner, {7, 6, 2});
  for (const double distance : {0.01, 0.1, 0.2, 1.0}) {
    EXPECT_EQ(countByCoverage(source, target, distance), countByForce(source, target, distance))
        << distance;
  }
}

/// Sources at distances from their target that differ by a few last digits, in random directions
/// and on the axes: decisions must be those of the double formula.
TEST(Coverage, DecidesBordersLikeTheFormulaInDouble) {
  RandomPoints random(3);
  constexpr double kDistance = 0.1;
  Points source;
  Points target;
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector3d q =
        2.0 * Eigen::Vector3d(i % 50, i / 50, 0.0) + random.box(1, {0, 0, 0}, {1, 1, 1})[0];
    Eigen::Vector3d direction = random.box(1, {-1, -1, -1}, {2, 2, 2})[0];
    if (i % 3 == 0) direction = Eigen::Vector3d::Unit(i % 9 / 3) * (i % 2 == 0 ? 1 : -1);
    const double ulps = static_cast<double>(i % 7 - 3) * 1e-16;
    target.push_back(q);
    source.push_back(q + direction.normalized() * kDistance * (1.0 + ulps));
  }
  const std::size_t expected = countByForce(source, target, kDistance);
  EXPECT_GT(expected, 500U);
  EXPECT_LT(expected, 2500U);
  EXPECT_EQ(countByCoverage(source, target, kDistance), expected);
}

/// Target points at the corners of sub-cells and source points at the corners of cells, a little
/// inside and outside: the extreme positions that the bits of the cells are decided for.
TEST(Coverage, BitsOfCellsHoldInTheirExtremeCorners) {
  constexpr double kDistance = 0.1;
  constexpr double kCell = kDistance / kCellsPerDistance;
  constexpr double kInset = 1e-9;
  Points source;
  for (int x = -6; x <= 6; ++x) {
    for (int y = -6; y <= 6; ++y) {
      for (int z = -6; z <= 6; ++z) {
        for (int side = 0; side < 8; ++side) {
          const Eigen::Vector3d sides((side & 1) != 0 ? 1 : -1, (side & 2) != 0 ? 1 : -1,
                                      (side & 4) != 0 ? 1 : -1);
          source.push_back(kCell * Eigen::Vector3d(x, y, z) + kInset * sides);
        }
      }
    }
  }
  const CellGrid source_grid(source, {0, 0, 0}, kDistance);
  for (int corner = 0; corner < 125; ++corner) {
    const Eigen::Vector3d sub(corner % 5, corner / 5 % 5, corner / 25);
    for (const double inset : {-kInset, kInset}) {
      const Eigen::Vector3d q = kCell / 4 * sub + Eigen::Vector3d::Constant(inset);
      for (const std::size_t copies : {1U, 5U, 30U}) {
        const Points target(copies, q);
        const CellGrid target_grid(target, {0, 0, 0}, kDistance);
        EXPECT_EQ(Coverage(target_grid).count(source_grid), countByForce(source, {q}, kDistance))
            << q.transpose();
      }
    }
  }
}

/// Many target points in one corner of a cell and sources at all angles around it: whole cells are
/// decided by their nearest and farthest corners.
TEST(Coverage, CellsOfDenseBlocksAreDecidedByTheirCorners) {
  constexpr double kCell = 0.1 / kCellsPerDistance;
  RandomPoints random(5);
  const Points source = random.box(20000, {-0.12, -0.12, -0.12}, {0.27, 0.27, 0.27});
  const CellGrid source_grid(source, {0, 0, 0}, 0.1);
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d inset(1e-6 * (1 - 2 * (corner & 1)), 1e-6 * (1 - (corner & 2)),
                                1e-6 * (1 - (corner & 4) / 2));
    const Eigen::Vector3d q =
        kCell * Eigen::Vector3d(corner & 1, corner >> 1 & 1, corner >> 2) + inset;
    const Points target(40, q);
    const CellGrid target_grid(target, {0, 0, 0}, 0.1);
    EXPECT_EQ(Coverage(target_grid).count(source_grid), countByForce(source, {q}, 0.1))
        << q.transpose();
  }
}

TEST(Coverage, IsStrict) {
  const Points target{{0, 0, 0}};
  EXPECT_EQ(countByCoverage({{0.25, 0, 0}}, target, 0.25), 0U);
  EXPECT_EQ(countByCoverage({{std::nextafter(0.25, 0.0), 0, 0}}, target, 0.25), 1U);
  EXPECT_EQ(countByCoverage({{0, 0, 0}}, target, 0.25), 1U);
}

TEST(Coverage, ReachesAcrossBlocksInAllDirections) {
  // The target's block begins at the origin; its neighbours in all 26 directions are sources.
  const Points target{{0, 0, 0}};
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const Eigen::Vector3d direction(x, y, z);
        if (direction.isZero()) continue;
        for (const double factor : {0.999, 1.001}) {
          const Eigen::Vector3d p = direction.normalized() * 0.1 * factor;
          EXPECT_EQ(countByCoverage({p}, target, 0.1), factor < 1.0 ? 1U : 0U) << p.transpose();
        }
      }
    }
  }
}

TEST(Coverage, CountsDuplicatesAndDenseClusters) {
  RandomPoints random(4);
  Points target = random.box(5000, {0, 0, 0}, {0.05, 0.05, 0.05});
  target.insert(target.end(), 1000, Eigen::Vector3d(1, 1, 1));
  Points source = random.box(2000, {-0.2, -0.2, -0.2}, {0.45, 0.45, 0.45});
  source.insert(source.end(), 500, Eigen::Vector3d(1.05, 1, 1));
  EXPECT_EQ(countByCoverage(source, target, 0.1), countByForce(source, target, 0.1));
}

TEST(Coverage, RefusesGridsThatDoNotLieOverEachOther) {
  const Points points{{0, 0, 0}};
  const CellGrid target(points, {0, 0, 0}, 0.1);
  const Coverage coverage(target);
  EXPECT_THROW(coverage.count(CellGrid(points, {0, 0, 0}, 0.2)), InvalidParameter);
  EXPECT_THROW(coverage.count(CellGrid(points, {1, 0, 0}, 0.1)), InvalidParameter);
}

TEST(CellGrid, RefusesImpossibleDistancesAndPointsInAnotherFrame) {
  const Points points{{0, 0, 0}};
  for (const double distance : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                                std::numeric_limits<double>::infinity(), 1e-320}) {
    EXPECT_THROW(CellGrid(points, {0, 0, 0}, distance), InvalidParameter) << distance;
  }
  EXPECT_NO_THROW(CellGrid(points, {2e6, 8e6, 0}, 0.5));
  EXPECT_THROW(CellGrid(points, {2e6, 8e6, 0}, 0.01), InvalidProblem);
}

TEST(CellGrid, EmptyCloudCoversNothing) {
  const CellGrid empty({}, {0, 0, 0}, 0.1);
  const CellGrid one(Points{{0, 0, 0}}, {0, 0, 0}, 0.1);
  EXPECT_EQ(Coverage(empty).count(one), 0U);
  EXPECT_EQ(Coverage(one).count(empty), 0U);
}

TEST(BlockTable, NumbersBlocksInTheOrderOfTheirFirstInsertion) {
  BlockTable table;
  std::uint32_t expected = 0;
  for (int x = -20; x < 20; ++x) {
    for (int y = -20; y < 20; ++y) EXPECT_EQ(table.insert({x, y, x * y}), expected++);
  }
  EXPECT_EQ(table.size(), expected);
  EXPECT_EQ(table.insert({-20, -20, 400}), 0U);
  EXPECT_EQ(table.find({19, 19, 361}), expected - 1);
  EXPECT_EQ(table.find({19, 19, 360}), BlockTable::kNone);
  EXPECT_EQ(table.find({-2147483648, 2147483647, 0}), BlockTable::kNone);
}

}  // namespace
}  // namespace pcrb
