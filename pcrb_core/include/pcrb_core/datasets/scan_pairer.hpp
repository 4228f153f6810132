#pragma once

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "pcrb_core/datasets/stamp.hpp"

namespace pcrb {

/// Pairs each scan of a left stream with the one of a right stream that is closest in time, the
/// earlier of two at the same distance; a right scan may serve several left ones.
///
/// Works on streams: a pair is given as soon as it cannot get better, and what no later left scan
/// can need is forgotten. Each stream must be in ascending order; how they interleave makes no
/// difference while they are within `patience` of each other.
/// @tparam Scan  cheap to copy, e.g. a shared pointer
template <typename Scan>
class ScanPairer {
 public:
  struct Pair {
    Stamp left_stamp;
    Scan left;
    std::optional<std::pair<Stamp, Scan>> right;  ///< nothing: none came in time
  };

  explicit ScanPairer(Stamp patience) : patience_(patience) {}

  std::vector<Pair> addLeft(Stamp stamp, Scan scan) {
    lefts_.emplace(stamp, std::move(scan));
    return takeDecided(stamp);
  }

  std::vector<Pair> addRight(Stamp stamp, Scan scan) {
    rights_.emplace(stamp, std::move(scan));
    return takeDecided(stamp);
  }

  /// The pairs that still wait, at the end of the streams.
  std::vector<Pair> flush() {
    std::vector<Pair> pairs;
    while (!lefts_.empty()) pairs.push_back(takeFirst());
    return pairs;
  }

  std::size_t waiting() const { return lefts_.size() + rights_.size(); }

 private:
  std::vector<Pair> takeDecided(Stamp stamp) {
    newest_ = std::max(newest_, stamp);
    std::vector<Pair> pairs;
    while (!lefts_.empty() && isDecided(lefts_.begin()->first)) pairs.push_back(takeFirst());
    forgetRights();
    return pairs;
  }

  bool isDecided(Stamp left) const {
    return rights_.lower_bound(left) != rights_.end() || newest_ - left > patience_;
  }

  Pair takeFirst() {
    const auto left = lefts_.begin();
    Pair pair{left->first, left->second, closestRight(left->first)};
    last_left_ = left->first;
    lefts_.erase(left);
    return pair;
  }

  std::optional<std::pair<Stamp, Scan>> closestRight(Stamp stamp) const {
    if (rights_.empty()) return std::nullopt;
    auto next = rights_.lower_bound(stamp);
    if (next == rights_.begin()) return *next;
    const auto previous = std::prev(next);
    if (next == rights_.end()) return *previous;
    return stamp - previous->first <= next->first - stamp ? *previous : *next;
  }

  /// Later left scans need the last right scan before them, and those after it.
  void forgetRights() {
    const Stamp reference =
        lefts_.empty() ? std::max(last_left_, newest_ - patience_) : lefts_.begin()->first;
    auto needed = rights_.upper_bound(reference);
    if (needed != rights_.begin()) rights_.erase(rights_.begin(), std::prev(needed));
  }

  Stamp patience_;
  Stamp newest_ = 0;
  Stamp last_left_ = 0;
  std::map<Stamp, Scan> lefts_;
  std::map<Stamp, Scan> rights_;
};

}  // namespace pcrb
