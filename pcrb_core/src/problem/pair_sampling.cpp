#include "pcrb_core/problem/pair_sampling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

/// The pairs of the ten intervals, those drawn in this round and those that are left.
class Intervals {
 public:
  /// @param quota  pairs of each interval that come from it alone where it has them.
  Intervals(const std::vector<CloudPair>& pairs, std::size_t quota, TopUp top_up)
      : quota_(quota), top_up_(top_up) {
    const std::vector<std::size_t> interval = overlapIntervals(pairs);
    for (std::size_t i = 0; i < pairs.size(); ++i) left_[interval[i]].push_back(i);
    all_ = left_;
  }

  /// Takes a random pair of the interval with the fewest drawn pairs among those that have some
  /// left; beyond the quota, with TopUp::kPaper, of all that are left.
  void draw(Random& random) {
    if (emptiest() == kOverlapIntervals) left_ = all_;
    std::size_t interval = emptiest();
    if (top_up_ == TopUp::kPaper && drawn_[interval].size() >= quota_) {
      interval = intervalOfAnyLeft(random);
    }
    std::vector<std::size_t>& left = left_[interval];
    std::swap(left[static_cast<std::size_t>(random.below(left.size()))], left.back());
    drawn_[interval].push_back(left.back());
    left.pop_back();
  }

  const std::array<std::vector<std::size_t>, kOverlapIntervals>& drawn() const { return drawn_; }

 private:
  /// kOverlapIntervals where no interval has a pair left.
  std::size_t emptiest() const {
    std::size_t found = kOverlapIntervals;
    for (std::size_t i = 0; i < kOverlapIntervals; ++i) {
      if (left_[i].empty()) continue;
      if (found == kOverlapIntervals || drawn_[i].size() < drawn_[found].size()) found = i;
    }
    return found;
  }

  /// Each pair that is left counts once.
  std::size_t intervalOfAnyLeft(Random& random) const {
    std::size_t count = 0;
    for (const auto& left : left_) count += left.size();
    auto place = static_cast<std::size_t>(random.below(count));
    std::size_t interval = 0;
    while (place >= left_[interval].size()) place -= left_[interval++].size();
    return interval;
  }

  std::size_t quota_;
  TopUp top_up_;
  std::array<std::vector<std::size_t>, kOverlapIntervals> all_;
  std::array<std::vector<std::size_t>, kOverlapIntervals> left_;
  std::array<std::vector<std::size_t>, kOverlapIntervals> drawn_;
};

}  // namespace

double minimalOverlap(Kind kind) { return kind == Kind::kLocal ? 0.4 : 0.6; }

std::vector<CloudPair> eligiblePairs(const OverlapMatrix& matrix, Kind kind) {
  std::vector<CloudPair> pairs;
  for (std::size_t source = 0; source < matrix.names.size(); ++source) {
    for (std::size_t target = 0; target < matrix.names.size(); ++target) {
      const double overlap = matrix.at(source, target);
      if (source == target || !(overlap >= minimalOverlap(kind) && overlap < 1.0)) continue;
      pairs.push_back({matrix.names[source], matrix.names[target], overlap});
    }
  }
  return pairs;
}

std::vector<std::size_t> overlapIntervals(const std::vector<CloudPair>& pairs) {
  if (pairs.empty()) throw InvalidProblem("found no pair of clouds with enough overlap");
  const auto [lowest, highest] = std::minmax_element(
      pairs.begin(), pairs.end(),
      [](const CloudPair& left, const CloudPair& right) { return left.overlap < right.overlap; });
  std::array<double, kOverlapIntervals> starts{};
  for (std::size_t i = 0; i < kOverlapIntervals; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(kOverlapIntervals);
    starts[i] = lowest->overlap + part * (highest->overlap - lowest->overlap);
  }
  std::vector<std::size_t> intervals;
  intervals.reserve(pairs.size());
  for (const CloudPair& pair : pairs) {
    const auto next = std::upper_bound(starts.begin() + 1, starts.end(), pair.overlap);
    intervals.push_back(static_cast<std::size_t>(next - starts.begin()) - 1);
  }
  // All overlaps equal: upper_bound puts them into the last interval, which holds them all.
  return intervals;
}

std::vector<CloudPair> samplePairs(const std::vector<CloudPair>& eligible, std::size_t count,
                                   Random& random, TopUp top_up) {
  Intervals intervals(eligible, count / kOverlapIntervals, top_up);
  for (std::size_t i = 0; i < count; ++i) intervals.draw(random);
  std::vector<CloudPair> sample;
  sample.reserve(count);
  for (const auto& interval : intervals.drawn()) {
    for (const std::size_t pair : interval) sample.push_back(eligible[pair]);
  }
  return sample;
}

}  // namespace pcrb
