#pragma once

#include <array>
#include <cstdint>

namespace pcrb {

/// Sub-cells per axis: where in its cell a target point lies, as far as footprints distinguish it.
constexpr int kSubcells = 4;

/// Cells to either side of a target point's cell that can be within the distance of the point.
constexpr int kReach = 5;

/// Cells around a cell with target points that are covered, as rows of bits along x: bit ox +
/// kReach of row (oz + kReach, oy + kReach) is the cell at offset (ox, oy, oz).
struct Footprint {
  static constexpr int kRows = 2 * kReach + 1;
  using Rows =
      std::array<std::array<std::uint32_t, kRows + 1>, kRows>;  ///< [z][y], one for padding
  Rows certain{};   ///< covered wherever in the sub-cell the target point lies
  Rows possible{};  ///< may be covered
};

/// The footprint of a target point in a sub-cell (each coordinate 0 … kSubcells − 1).
const Footprint& footprintOfSubcell(int x, int y, int z);

/// The footprint of at least one target point anywhere in a cell.
const Footprint& footprintOfCell();

}  // namespace pcrb
