#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pcrb_core/search/block_table.hpp"

namespace pcrb {

/// Cells per axis of a block.
constexpr int kCellsPerBlock = 8;

/// Length of a search distance in cells: a ball of that radius reaches half a block.
constexpr int kCellsPerDistance = 4;
constexpr double kSquaredCellsPerDistance = kCellsPerDistance * kCellsPerDistance;

/// Margin of decisions on squared distances in cells: coordinates in cells are wrong by less than
/// 1e-6 and distances in question are at most 13 cells, so that squares are wrong by less than
/// 1e-4.
constexpr double kSquaredCellMargin = 1e-3;

/// A cloud's points sorted into a sparse grid of cubic cells, made for one search distance.
///
/// The edge of a cell is a quarter of the distance; 8 × 8 × 8 cells form a block. Grids with the
/// same origin and distance can be laid over each other. Points are kept in double: 24 bytes a
/// point, 8 bytes an occupied cell and about 40 bytes an occupied block.
class CellGrid {
 public:
  struct Block {
    BlockKey key;
    std::uint32_t first_cell;
  };
  struct Cell {
    std::uint32_t first_point;
    std::uint16_t index;  ///< in the block: x + 8 y + 64 z
  };

  /// @param points    m, finite.
  /// @param origin    m; errors of cell coordinates stay below 1e-6 cells within 1e8 cells of it.
  /// @param distance  m, > 0.
  /// @throws InvalidParameter  if the distance is not positive and finite.
  /// @throws InvalidProblem    if a point is farther from the origin than that on any axis, or if
  ///                           there are 2^32 points or more.
  CellGrid(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& origin,
           double distance);

  std::size_t size() const { return x_.size(); }
  double distance() const { return distance_; }
  const Eigen::Vector3d& origin() const { return origin_; }
  std::size_t blockCount() const { return blocks_.size() - 1; }

  /// The b-th block; blockCount() gives the end of the last one's cells.
  const Block& block(std::size_t b) const { return blocks_[b]; }
  /// The c-th cell; the last block's end gives the end of the last one's points.
  const Cell& cell(std::size_t c) const { return cells_[c]; }

  /// The number of an occupied block, or BlockTable::kNone.
  std::uint32_t findBlock(const BlockKey& key) const { return table_.find(key); }

  Eigen::Vector3d point(std::size_t p) const { return {x_[p], y_[p], z_[p]}; }

  /// A point's coordinates in cells, relative to a block's corner.
  Eigen::Vector3d cellCoordinates(const Eigen::Vector3d& point, const BlockKey& key) const;

  /// Whether one of a block's points is strictly closer to `point` than the distance.
  bool blockHasPointNear(std::uint32_t block, const Eigen::Vector3d& point) const;

  /// Memory that the grid holds, bytes.
  std::size_t bytes() const;

 private:
  struct Position {
    std::uint32_t block;
    std::uint16_t cell;
  };
  struct Entry {
    std::uint16_t cell;
    std::uint32_t point;
  };

  Position locate(const Eigen::Vector3d& point, std::vector<BlockKey>& keys);
  void sortIntoBlocks(const std::vector<Eigen::Vector3d>& points,
                      const std::vector<Position>& positions, const std::vector<BlockKey>& keys);
  bool hasPointNear(std::uint32_t begin, std::uint32_t end, const Eigen::Vector3d& point) const;
  void appendBlock(const std::vector<Eigen::Vector3d>& points, const BlockKey& key, Entry* begin,
                   Entry* end);

  Eigen::Vector3d origin_;
  double distance_;
  double cells_per_metre_;
  BlockTable table_;
  std::vector<Block> blocks_;      ///< and one past the end
  std::vector<Cell> cells_;        ///< and one past the end
  std::vector<double> x_, y_, z_;  ///< sorted by block and cell
};

}  // namespace pcrb
