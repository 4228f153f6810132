#include "pcrb_core/search/block_table.hpp"

#include <utility>

namespace pcrb {

BlockTable::BlockTable(std::size_t expected_blocks) {
  // A surface fills about four of a group's eight blocks; the table is at most half full.
  int bits = 4;
  while ((std::size_t{1} << bits) < expected_blocks / 2) ++bits;
  groups_.resize(std::size_t{1} << bits);
  shift_ = 64 - bits;
}

std::uint32_t BlockTable::insert(const BlockKey& key) {
  const BlockKey wanted = groupKey(key);
  const std::size_t mask = groups_.size() - 1;
  std::size_t probe = firstProbe(wanted);
  while (groups_[probe].used != 0 && !(groups_[probe].key == wanted)) probe = (probe + 1) & mask;
  Group& group = groups_[probe];
  if (group.used == 0) {
    if (2 * used_groups_ >= groups_.size()) {
      grow();
      return insert(key);
    }
    group.used = 1;
    group.key = wanted;
    ++used_groups_;
  }
  std::uint32_t& number = group.numbers[slot(key)];
  if (number == kNone) number = static_cast<std::uint32_t>(size_++);
  return number;
}

void BlockTable::grow() {
  std::vector<Group> old(2 * groups_.size());
  std::swap(old, groups_);
  --shift_;
  const std::size_t mask = groups_.size() - 1;
  for (const Group& group : old) {
    if (group.used == 0) continue;
    std::size_t probe = firstProbe(group.key);
    while (groups_[probe].used != 0) probe = (probe + 1) & mask;
    groups_[probe] = group;
  }
}

}  // namespace pcrb
