#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pcrb_core/search/block_table.hpp"
#include "search/cell_grid.hpp"

namespace pcrb {

/// Which part of space is closer to a target cloud than a distance: two bits for every cell around
/// the target's points.
///
/// `certain`: every position in the cell is strictly closer to some target point than the distance;
/// `possible`: some position may be. Both are decided with a margin that is far above the rounding
/// of coordinates, so that only points in cells that are possible and not certain need distances,
/// which are then computed in double. Made once per target and used for all of its sources.
class Coverage {
 public:
  /// @param target  must outlive this object.
  explicit Coverage(const CellGrid& target);

  /// How many of the source's points have a target point strictly closer than the distance.
  ///
  /// Exact: the squared distance is (dx² + dy²) + dz² in double. Can be called from several
  /// threads.
  /// @throws InvalidParameter  if the source's grid has another origin or distance.
  std::size_t count(const CellGrid& source) const;

  /// Memory that the coverage holds, bytes.
  std::size_t bytes() const { return table_.bytes() + blocks_.capacity() * sizeof(Bits); }

 private:
  struct Bits {
    std::array<std::uint64_t, 8> certain{};  ///< one word per z; bit x + 8 y
    std::array<std::uint64_t, 8> possible{};
  };

  class Canvas;

  const CellGrid& target_;
  BlockTable table_;
  std::vector<Bits> blocks_;
};

}  // namespace pcrb
