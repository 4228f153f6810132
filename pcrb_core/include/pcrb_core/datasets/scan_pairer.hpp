#pragma once

#include <algorithm>
#include <cstdlib>
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
///
/// When a stream goes back, its log is played again: what waits is given with the best partner so
/// far, and pairing begins anew. A left scan that comes again is given again; its partner may be a
/// closer one, where the log had not been played around it.
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
    std::vector<Pair> pairs = follow(left_, right_, stamp);
    if (left_.is_behind) {
      pairs.push_back({stamp, std::move(scan), std::nullopt});
    } else {
      left_.scans.emplace(stamp, std::move(scan));
      takeDecided(stamp, pairs);
    }
    return pairs;
  }

  std::vector<Pair> addRight(Stamp stamp, Scan scan) {
    std::vector<Pair> pairs = follow(right_, left_, stamp);
    if (!right_.is_behind) {
      right_.scans.emplace(stamp, std::move(scan));
      takeDecided(stamp, pairs);
    }
    return pairs;
  }

  /// The pairs that still wait, at the end of the streams.
  std::vector<Pair> flush() {
    std::vector<Pair> pairs;
    while (!left_.scans.empty()) pairs.push_back(takeFirst());
    return pairs;
  }

  std::size_t waiting() const { return left_.scans.size() + right_.scans.size(); }

 private:
  struct Stream {
    StreamClock clock;
    bool is_behind = false;  ///< the other stream went back, and this one did not yet
    std::map<Stamp, Scan> scans;
  };

  /// Begins anew when a stream goes back; gives what waited. What the other one still sends from
  /// before must not be paired with what comes now.
  std::vector<Pair> follow(Stream& stream, Stream& other, Stamp stamp) {
    const bool goes_back = stream.clock.goesBack(stamp);
    if (stream.is_behind) {
      stream.is_behind = !goes_back && std::abs(stamp - newest_) > patience_;
      return {};
    }
    if (!goes_back) return {};
    std::vector<Pair> pairs = flush();
    right_.scans.clear();
    newest_ = 0;
    last_left_ = 0;
    other.is_behind = other.clock.hasStarted();
    return pairs;
  }

  void takeDecided(Stamp stamp, std::vector<Pair>& pairs) {
    newest_ = std::max(newest_, stamp);
    while (!left_.scans.empty() && isDecided(left_.scans.begin()->first)) {
      pairs.push_back(takeFirst());
    }
    forgetRights();
  }

  bool isDecided(Stamp left) const {
    return right_.scans.lower_bound(left) != right_.scans.end() || newest_ - left > patience_;
  }

  Pair takeFirst() {
    const auto left = left_.scans.begin();
    Pair pair{left->first, left->second, closestRight(left->first)};
    last_left_ = left->first;
    left_.scans.erase(left);
    return pair;
  }

  std::optional<std::pair<Stamp, Scan>> closestRight(Stamp stamp) const {
    const auto& rights = right_.scans;
    if (rights.empty()) return std::nullopt;
    auto next = rights.lower_bound(stamp);
    if (next == rights.begin()) return *next;
    const auto previous = std::prev(next);
    if (next == rights.end()) return *previous;
    return stamp - previous->first <= next->first - stamp ? *previous : *next;
  }

  /// Later left scans need the last right scan before them, and those after it.
  void forgetRights() {
    const Stamp reference = left_.scans.empty() ? std::max(last_left_, newest_ - patience_)
                                                : left_.scans.begin()->first;
    auto& rights = right_.scans;
    auto needed = rights.upper_bound(reference);
    if (needed != rights.begin()) rights.erase(rights.begin(), std::prev(needed));
  }

  Stamp patience_;
  Stamp newest_ = 0;
  Stamp last_left_ = 0;
  Stream left_;
  Stream right_;
};

}  // namespace pcrb
