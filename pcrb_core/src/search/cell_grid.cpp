#include "search/cell_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

#include "arithmetic.hpp"
#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

/// Whether one of n points is strictly closer to p than the square root of `squared_distance`.
///
/// The squared distance is (dx² + dy²) + dz² in double, rounded after every operation, as k-d trees
/// in double have it: decisions are equal to theirs to the last bit.
PCRB_CLONES
bool anyCloser(const double* x, const double* y, const double* z, std::size_t n, const double* p,
               double squared_distance) {
  constexpr std::size_t kChunk = 16;
  const double px = p[0];
  const double py = p[1];
  const double pz = p[2];
  std::size_t i = 0;
  for (; i + kChunk <= n; i += kChunk) {
    int closer = 0;
    for (std::size_t j = i; j < i + kChunk; ++j) {
      const double dx = x[j] - px;
      const double dy = y[j] - py;
      const double dz = z[j] - pz;
      closer |= static_cast<int>(dx * dx + dy * dy + dz * dz < squared_distance);
    }
    if (closer != 0) return true;
  }
  for (; i < n; ++i) {
    const double dx = x[i] - px;
    const double dy = y[i] - py;
    const double dz = z[i] - pz;
    if (dx * dx + dy * dy + dz * dz < squared_distance) return true;
  }
  return false;
}

/// Beyond this many cells from the origin, coordinates in cells lose the precision that Coverage's
/// margins are made for.
constexpr double kMaxCells = 1e8;

/// In a block with more points, cells that are wholly near or far spare the distances of theirs.
constexpr std::uint32_t kMaxPointsWithoutCells = 24;

/// Squares of the smallest and the largest distance from a position to the cells of a block, axis
/// by axis, in cells.
class CellDistances {
 public:
  /// @param position  in cells, relative to the block's corner.
  explicit CellDistances(const Eigen::Vector3d& position) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t cell = 0; cell < kCellsPerBlock; ++cell) {
        const double below = position[static_cast<Eigen::Index>(axis)] - static_cast<double>(cell);
        const double above = 1.0 - below;
        const double near = std::max({0.0, below - 1.0, -below});
        const double far = std::max(below, above);
        nearest_[axis][cell] = near * near;
        farthest_[axis][cell] = far * far;
      }
    }
  }

  /// Whether all positions in the cell are certainly closer than the search distance.
  bool isWithin(std::uint16_t cell) const {
    return sum(farthest_, cell) < kSquaredCellsPerDistance - kSquaredCellMargin;
  }

  /// Whether all positions in the cell are certainly farther than the search distance.
  bool isBeyond(std::uint16_t cell) const {
    return sum(nearest_, cell) > kSquaredCellsPerDistance + kSquaredCellMargin;
  }

 private:
  using Table = std::array<std::array<double, kCellsPerBlock>, 3>;

  static double sum(const Table& table, std::uint16_t cell) {
    return table[0][cell & 7] + table[1][cell >> 3 & 7] + table[2][cell >> 6];
  }

  Table nearest_;
  Table farthest_;
};

}  // namespace

CellGrid::CellGrid(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& origin,
                   double distance)
    : origin_(origin),
      distance_(distance),
      cells_per_metre_(kCellsPerDistance / distance),
      table_(points.size() / 8) {
  if (!(distance > 0.0) || !std::isfinite(cells_per_metre_) || !std::isfinite(distance)) {
    throw InvalidParameter("found a search distance of " + std::to_string(distance) +
                           " m, expected a positive one");
  }
  const std::size_t n = points.size();
  if (n >= std::numeric_limits<std::uint32_t>::max()) {
    throw InvalidProblem("found a cloud of " + std::to_string(n) +
                         " points, expected fewer than 2^32");
  }
  std::vector<BlockKey> keys;
  std::vector<Position> positions;
  positions.reserve(n);
  for (const auto& point : points) positions.push_back(locate(point, keys));
  sortIntoBlocks(points, positions, keys);
}

void CellGrid::sortIntoBlocks(const std::vector<Eigen::Vector3d>& points,
                              const std::vector<Position>& positions,
                              const std::vector<BlockKey>& keys) {
  const std::size_t n = points.size();
  std::vector<std::uint32_t> first(keys.size() + 1, 0);
  for (const Position& position : positions) ++first[position.block + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<Entry> order(n);
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (std::size_t i = 0; i < n; ++i) {
    order[next[positions[i].block]++] = {positions[i].cell, static_cast<std::uint32_t>(i)};
  }

  x_.reserve(n);
  y_.reserve(n);
  z_.reserve(n);
  blocks_.reserve(keys.size() + 1);
  for (std::size_t b = 0; b < keys.size(); ++b) {
    appendBlock(points, keys[b], order.data() + first[b], order.data() + first[b + 1]);
  }
  blocks_.push_back({BlockKey{}, static_cast<std::uint32_t>(cells_.size())});
  cells_.push_back({static_cast<std::uint32_t>(n), 0});
  cells_.shrink_to_fit();
}

void CellGrid::appendBlock(const std::vector<Eigen::Vector3d>& points, const BlockKey& key,
                           Entry* begin, Entry* end) {
  std::sort(begin, end, [](const Entry& left, const Entry& right) {
    return left.cell != right.cell ? left.cell < right.cell : left.point < right.point;
  });
  blocks_.push_back({key, static_cast<std::uint32_t>(cells_.size())});
  for (const Entry* entry = begin; entry != end; ++entry) {
    if (entry == begin || entry->cell != (entry - 1)->cell) {
      cells_.push_back({static_cast<std::uint32_t>(x_.size()), entry->cell});
    }
    const Eigen::Vector3d& point = points[entry->point];
    x_.push_back(point.x());
    y_.push_back(point.y());
    z_.push_back(point.z());
  }
}

CellGrid::Position CellGrid::locate(const Eigen::Vector3d& point, std::vector<BlockKey>& keys) {
  const Eigen::Vector3d offset = (point - origin_) * cells_per_metre_;
  if (!(offset.lpNorm<Eigen::Infinity>() <= kMaxCells)) {
    std::ostringstream message;
    message << "found a point " << (point - origin_).norm()
            << " m from the first cloud's first point, expected at most "
            << kMaxCells / cells_per_metre_ << " m: are the clouds in one frame?";
    throw InvalidProblem(message.str());
  }
  const auto x = static_cast<std::int32_t>(std::floor(offset.x()));
  const auto y = static_cast<std::int32_t>(std::floor(offset.y()));
  const auto z = static_cast<std::int32_t>(std::floor(offset.z()));
  const BlockKey key{x >> 3, y >> 3, z >> 3};
  // Scans are in scan order: the block is mostly the last point's.
  std::uint32_t block;
  if (!keys.empty() && key == keys.back()) {
    block = static_cast<std::uint32_t>(keys.size() - 1);
  } else {
    block = table_.insert(key);
    if (block == keys.size()) keys.push_back(key);
  }
  return {block, static_cast<std::uint16_t>((x & 7) | (y & 7) << 3 | (z & 7) << 6)};
}

Eigen::Vector3d CellGrid::cellCoordinates(const Eigen::Vector3d& point, const BlockKey& key) const {
  return (point - origin_) * cells_per_metre_ -
         kCellsPerBlock * Eigen::Vector3d(key.x, key.y, key.z);
}

bool CellGrid::blockHasPointNear(std::uint32_t block, const Eigen::Vector3d& point) const {
  const std::uint32_t first_cell = blocks_[block].first_cell;
  const std::uint32_t end_cell = blocks_[block + 1].first_cell;
  const std::uint32_t begin = cells_[first_cell].first_point;
  const std::uint32_t end = cells_[end_cell].first_point;
  if (end - begin <= kMaxPointsWithoutCells) return hasPointNear(begin, end, point);

  const CellDistances distances(cellCoordinates(point, blocks_[block].key));
  for (std::uint32_t c = first_cell; c < end_cell; ++c) {
    if (distances.isWithin(cells_[c].index)) return true;
    if (distances.isBeyond(cells_[c].index)) continue;
    if (hasPointNear(cells_[c].first_point, cells_[c + 1].first_point, point)) return true;
  }
  return false;
}

bool CellGrid::hasPointNear(std::uint32_t begin, std::uint32_t end,
                            const Eigen::Vector3d& point) const {
  return anyCloser(x_.data() + begin, y_.data() + begin, z_.data() + begin, end - begin,
                   point.data(), distance_ * distance_);
}

std::size_t CellGrid::bytes() const {
  return table_.bytes() + blocks_.capacity() * sizeof(Block) + cells_.capacity() * sizeof(Cell) +
         (x_.capacity() + y_.capacity() + z_.capacity()) * sizeof(double);
}

}  // namespace pcrb
