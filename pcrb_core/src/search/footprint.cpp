#include "search/footprint.hpp"

#include <algorithm>
#include <vector>

#include "search/cell_grid.hpp"

namespace pcrb {
namespace {

/// Squares of the largest and of the smallest distance along one axis between the interval
/// [low, high] and the cell [offset, offset + 1].
struct AxisDistance {
  double largest;
  double smallest;
};

AxisDistance axisDistance(double low, double high, int offset) {
  const double far = std::max(offset + 1 - low, high - offset);
  const double near = std::max({0.0, offset - high, low - (offset + 1)});
  return {far * far, near * near};
}

/// The footprint of a box in the cell (0, 0, 0): position `corner`, edge length `edge`, in cells.
Footprint makeFootprint(const std::array<double, 3>& corner, double edge) {
  std::array<std::array<AxisDistance, Footprint::kRows>, 3> axis{};
  for (std::size_t a = 0; a < 3; ++a) {
    for (int offset = -kReach; offset <= kReach; ++offset) {
      axis[a][static_cast<std::size_t>(offset + kReach)] =
          axisDistance(corner[a], corner[a] + edge, offset);
    }
  }
  Footprint footprint;
  for (std::size_t z = 0; z < Footprint::kRows; ++z) {
    for (std::size_t y = 0; y < Footprint::kRows; ++y) {
      for (std::size_t x = 0; x < Footprint::kRows; ++x) {
        const double largest = axis[0][x].largest + axis[1][y].largest + axis[2][z].largest;
        const double smallest = axis[0][x].smallest + axis[1][y].smallest + axis[2][z].smallest;
        if (largest < kSquaredCellsPerDistance - kSquaredCellMargin)
          footprint.certain[z][y] |= 1U << x;
        if (smallest < kSquaredCellsPerDistance + kSquaredCellMargin)
          footprint.possible[z][y] |= 1U << x;
      }
    }
  }
  return footprint;
}

std::vector<Footprint> makeSubcellFootprints() {
  std::vector<Footprint> footprints;
  for (int z = 0; z < kSubcells; ++z) {
    for (int y = 0; y < kSubcells; ++y) {
      for (int x = 0; x < kSubcells; ++x) {
        constexpr double kEdge = 1.0 / kSubcells;
        footprints.push_back(makeFootprint({x * kEdge, y * kEdge, z * kEdge}, kEdge));
      }
    }
  }
  return footprints;
}

}  // namespace

const Footprint& footprintOfSubcell(int x, int y, int z) {
  static const std::vector<Footprint> footprints = makeSubcellFootprints();
  return footprints[static_cast<std::size_t>((z * kSubcells + y) * kSubcells + x)];
}

const Footprint& footprintOfCell() {
  static const Footprint footprint = makeFootprint({0.0, 0.0, 0.0}, 1.0);
  return footprint;
}

}  // namespace pcrb
