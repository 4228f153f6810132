#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcrb {

/// Integer coordinates of a cube of a regular grid.
struct BlockKey {
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t z = 0;

  bool operator==(const BlockKey& other) const {
    return x == other.x && y == other.y && z == other.z;
  }
};

/// Numbers the blocks of a sparse grid 0, 1, 2 … in the order in which they are first seen.
///
/// Open addressing; the entries of 2 × 2 × 2 neighbouring blocks lie side by side, since blocks are
/// looked up in groups.
class BlockTable {
 public:
  explicit BlockTable(std::size_t expected_blocks = 0);

  /// The block's number, which is given to it now if it has none.
  std::uint32_t insert(const BlockKey& key);

  /// The block's number, or kNone.
  std::uint32_t find(const BlockKey& key) const {
    const Group* group = findGroup(key);
    return group == nullptr ? kNone : group->numbers[slot(key)];
  }

  std::size_t size() const { return size_; }
  std::size_t bytes() const { return groups_.size() * sizeof(Group); }

  static constexpr std::uint32_t kNone = 0xffffffffU;

 private:
  struct Group {
    BlockKey key;            ///< of the group: block coordinates divided by 2, rounded down
    std::uint32_t used = 0;  ///< 0 = the entry is free
    std::uint32_t numbers[8] = {kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone};
  };

  static BlockKey groupKey(const BlockKey& key) { return {key.x >> 1, key.y >> 1, key.z >> 1}; }
  static std::size_t slot(const BlockKey& key) {
    return static_cast<std::size_t>((key.x & 1) | (key.y & 1) << 1 | (key.z & 1) << 2);
  }
  static std::uint64_t hash(const BlockKey& group) {
    std::uint64_t h = static_cast<std::uint32_t>(group.x) * 0x9e3779b97f4a7c15ULL;
    h ^= static_cast<std::uint32_t>(group.y) * 0xc2b2ae3d27d4eb4fULL;
    h ^= static_cast<std::uint32_t>(group.z) * 0x165667b19e3779f9ULL;
    return (h ^ h >> 32) * 0x9e3779b97f4a7c15ULL;
  }
  std::size_t firstProbe(const BlockKey& group) const {
    return static_cast<std::size_t>(hash(group) >> shift_);
  }

  const Group* findGroup(const BlockKey& key) const {
    const BlockKey wanted = groupKey(key);
    const std::size_t mask = groups_.size() - 1;
    for (std::size_t probe = firstProbe(wanted);; probe = (probe + 1) & mask) {
      const Group& group = groups_[probe];
      if (group.used == 0) return nullptr;
      if (group.key == wanted) return &group;
    }
  }

  void grow();

  std::vector<Group> groups_;
  std::size_t used_groups_ = 0;
  std::size_t size_ = 0;
  int shift_ = 0;
};

}  // namespace pcrb
