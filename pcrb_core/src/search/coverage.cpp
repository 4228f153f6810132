#include "search/coverage.hpp"

#include <algorithm>
#include <cmath>

#include "pcrb_core/error.hpp"
#include "search/footprint.hpp"

namespace pcrb {
namespace {

/// Cells with more points than this get one footprint for the whole cell: around a scanner, points
/// are so dense that the neighbouring cells decide anyway.
constexpr std::uint32_t kMaxFootprintsPerCell = 3;

/// Half a block and the error of coordinates in cells.
constexpr double kHalfBlock = kCellsPerBlock / 2;
constexpr double kCellMargin = 1e-5;

/// Neighbours of a block along one axis that a ball of the search distance around a coordinate (in
/// cells, relative to the block) can touch.
struct AxisReach {
  int first;
  int last;
};

AxisReach axisReach(double coordinate) {
  return {coordinate < kHalfBlock + kCellMargin ? -1 : 0,
          coordinate > kHalfBlock - kCellMargin ? 1 : 0};
}

std::size_t neighbour(int dx, int dy, int dz) {
  return static_cast<std::size_t>((dz + 1) * 9 + (dy + 1) * 3 + dx + 1);
}

/// The target's blocks around one block of the source, looked up when they are first needed.
class Neighbourhood {
 public:
  Neighbourhood(const CellGrid& target, const BlockKey& key) : target_(target), key_(key) {
    blocks_.fill(kUnknown);
  }

  bool hasPointNear(const Eigen::Vector3d& point) {
    const Eigen::Vector3d cells = target_.cellCoordinates(point, key_);
    if (hasPointNear(0, 0, 0, point)) return true;
    const AxisReach x = axisReach(cells.x());
    const AxisReach y = axisReach(cells.y());
    const AxisReach z = axisReach(cells.z());
    for (int dz = z.first; dz <= z.last; ++dz) {
      for (int dy = y.first; dy <= y.last; ++dy) {
        for (int dx = x.first; dx <= x.last; ++dx) {
          if ((dx | dy | dz) != 0 && hasPointNear(dx, dy, dz, point)) return true;
        }
      }
    }
    return false;
  }

 private:
  static constexpr std::uint32_t kUnknown = BlockTable::kNone - 1;

  bool hasPointNear(int dx, int dy, int dz, const Eigen::Vector3d& point) {
    std::uint32_t& block = blocks_[neighbour(dx, dy, dz)];
    if (block == kUnknown) block = target_.findBlock({key_.x + dx, key_.y + dy, key_.z + dz});
    return block != BlockTable::kNone && target_.blockHasPointNear(block, point);
  }

  const CellGrid& target_;
  BlockKey key_;
  std::array<std::uint32_t, 27> blocks_;
};

int subcell(double coordinate) {
  const int sub = static_cast<int>(std::floor(coordinate * kSubcells));
  return sub & (kSubcells - 1);
}

}  // namespace

/// The cells of 3 × 3 × 3 blocks as rows of bits along x, on which the footprints of the middle
/// block's points are put before they are merged into the blocks.
class Coverage::Canvas {
 public:
  void clear() {
    certain_ = {};
    possible_ = {};
    low_ = kRows;
    high_ = 0;
  }

  /// Puts a footprint for a cell of the middle block.
  void put(const Footprint& footprint, std::uint16_t cell) {
    const std::size_t first_x = kFirst + (cell & 7);
    const std::size_t first_y = kFirst + (cell >> 3 & 7);
    const std::size_t first_z = kFirst + (cell >> 6);
    low_ = std::min(low_, first_z);
    high_ = std::max(high_, first_z + Footprint::kRows);
    for (std::size_t z = 0; z < Footprint::kRows; ++z) {
      Row* certain = certain_[first_z + z].data() + first_y;
      Row* possible = possible_[first_z + z].data() + first_y;
      for (std::size_t y = 0; y < Footprint::kRows + 1; ++y) {
        certain[y] |= footprint.certain[z][y] << first_x;
        possible[y] |= footprint.possible[z][y] << first_x;
      }
    }
  }

  /// Merges the canvas into the coverage's blocks around `key`.
  void merge(const BlockKey& key, Coverage& coverage) const {
    for (std::size_t bz = low_ / kCellsPerBlock; bz * kCellsPerBlock < high_; ++bz) {
      for (std::size_t by = 0; by < 3; ++by) {
        for (std::size_t bx = 0; bx < 3; ++bx) mergeBlock(key, bx, by, bz, coverage);
      }
    }
  }

 private:
  using Row = std::uint32_t;
  static constexpr std::size_t kRows = 3 * kCellsPerBlock;
  static constexpr std::size_t kFirst = kCellsPerBlock - kReach;
  using Rows = std::array<std::array<Row, kRows>, kRows>;  ///< [z][y]

  /// The word of one block and one z: eight rows' bytes.
  static std::uint64_t word(const Row* rows, std::size_t bx) {
    std::uint64_t bits = 0;
    for (std::size_t y = 0; y < kCellsPerBlock; ++y) {
      bits |= static_cast<std::uint64_t>(rows[y] >> (kCellsPerBlock * bx) & 0xff)
              << (kCellsPerBlock * y);
    }
    return bits;
  }

  void mergeBlock(const BlockKey& key, std::size_t bx, std::size_t by, std::size_t bz,
                  Coverage& coverage) const {
    std::array<std::uint64_t, kCellsPerBlock> possible{};
    std::uint64_t any = 0;
    for (std::size_t z = 0; z < kCellsPerBlock; ++z) {
      const Row* rows = possible_[bz * kCellsPerBlock + z].data() + by * kCellsPerBlock;
      possible[z] = word(rows, bx);
      any |= possible[z];
    }
    if (any == 0) return;
    const std::uint32_t number =
        coverage.table_.insert({key.x + static_cast<int>(bx) - 1, key.y + static_cast<int>(by) - 1,
                                key.z + static_cast<int>(bz) - 1});
    if (number == coverage.blocks_.size()) coverage.blocks_.emplace_back();
    Bits& bits = coverage.blocks_[number];
    for (std::size_t z = 0; z < kCellsPerBlock; ++z) {
      const Row* rows = certain_[bz * kCellsPerBlock + z].data() + by * kCellsPerBlock;
      bits.certain[z] |= word(rows, bx);
      bits.possible[z] |= possible[z];
    }
  }

  Rows certain_{};
  Rows possible_{};
  std::size_t low_ = kRows;
  std::size_t high_ = 0;
};

Coverage::Coverage(const CellGrid& target) : target_(target), table_(2 * target.blockCount()) {
  blocks_.reserve(2 * target.blockCount());
  Canvas canvas;
  for (std::size_t b = 0; b < target.blockCount(); ++b) {
    const BlockKey& key = target.block(b).key;
    canvas.clear();
    for (std::size_t c = target.block(b).first_cell; c < target.block(b + 1).first_cell; ++c) {
      const CellGrid::Cell& cell = target.cell(c);
      const std::uint32_t end = target.cell(c + 1).first_point;
      if (end - cell.first_point > kMaxFootprintsPerCell) {
        canvas.put(footprintOfCell(), cell.index);
        continue;
      }
      for (std::uint32_t p = cell.first_point; p < end; ++p) {
        const Eigen::Vector3d cells = target.cellCoordinates(target.point(p), key);
        canvas.put(footprintOfSubcell(subcell(cells.x()), subcell(cells.y()), subcell(cells.z())),
                   cell.index);
      }
    }
    canvas.merge(key, *this);
  }
}

std::size_t Coverage::count(const CellGrid& source) const {
  if (source.distance() != target_.distance() || source.origin() != target_.origin()) {
    throw InvalidParameter("found grids of different origin or distance, expected the same");
  }
  std::size_t count = 0;
  for (std::size_t b = 0; b < source.blockCount(); ++b) {
    const CellGrid::Block& block = source.block(b);
    const std::uint32_t number = table_.find(block.key);
    if (number == BlockTable::kNone) continue;
    const Bits& bits = blocks_[number];
    Neighbourhood neighbourhood(target_, block.key);
    for (std::size_t c = block.first_cell; c < source.block(b + 1).first_cell; ++c) {
      const CellGrid::Cell& cell = source.cell(c);
      const std::uint32_t end = source.cell(c + 1).first_point;
      const std::size_t z = cell.index >> 6;
      const unsigned bit = cell.index & 63U;
      if ((bits.certain[z] >> bit & 1U) != 0) {
        count += end - cell.first_point;
      } else if ((bits.possible[z] >> bit & 1U) != 0) {
        for (std::uint32_t p = cell.first_point; p < end; ++p) {
          count += neighbourhood.hasPointNear(source.point(p)) ? 1 : 0;
        }
      }
    }
  }
  return count;
}

}  // namespace pcrb
