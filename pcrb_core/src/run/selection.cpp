#include "run/selection.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "pcrb_core/error.hpp"
#include "pcrb_core/problem/perturbation.hpp"
#include "pcrb_core/random.hpp"

namespace pcrb {
namespace {

using Positions = std::vector<std::size_t>;

std::string nameOf(const PlannedProblem& c) {
  return c.key.data_set + "/" + c.key.sequence + " " + toString(c.key.kind);
}

/// Positions ordered by data set, sequence, kind and id: what the list's own order cannot change.
Positions sortedPositions(const std::vector<PlannedProblem>& problems) {
  const auto key = [&](std::size_t position) {
    const PlannedProblem& c = problems[position];
    return std::tie(c.key.data_set, c.key.sequence, c.key.kind, c.key.problem_id);
  };
  Positions positions(problems.size());
  std::iota(positions.begin(), positions.end(), std::size_t{0});
  std::sort(positions.begin(), positions.end(),
            [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  return positions;
}

/// The problems of each sequence and kind, sorted.
std::vector<Positions> strataOf(const std::vector<PlannedProblem>& problems) {
  std::map<std::tuple<std::string, std::string, Kind>, Positions> strata;
  for (const std::size_t position : sortedPositions(problems)) {
    const PlannedProblem& c = problems[position];
    strata[{c.key.data_set, c.key.sequence, c.key.kind}].push_back(position);
  }
  std::vector<Positions> list;
  for (auto& [key, positions] : strata) list.push_back(std::move(positions));
  return list;
}

/// Draws problems of one stratum: in rounds, each taking one of every pair of clouds that has any
/// left, pairs and their problems in random order.
Positions drawFromStratum(const std::vector<PlannedProblem>& problems, const Positions& stratum,
                          std::size_t count, Random& random) {
  std::map<std::pair<std::string, std::string>, Positions> by_pair;
  for (const std::size_t position : stratum) {
    by_pair[{problems[position].problem.source, problems[position].problem.target}].push_back(
        position);
  }
  std::vector<Positions> pairs;
  for (auto& [names, positions] : by_pair) {
    random.shuffle(positions);
    pairs.push_back(std::move(positions));
  }
  random.shuffle(pairs);
  Positions drawn;
  for (std::size_t round = 0; drawn.size() < count; ++round) {
    for (const Positions& pair : pairs) {
      if (round < pair.size() && drawn.size() < count) drawn.push_back(pair[round]);
    }
  }
  return drawn;
}

/// Number of elements that each part takes of a list: equal but for the remainder, which is given
/// to one part after the other, over all lists.
class ShareAllocator {
 public:
  explicit ShareAllocator(std::size_t parts) : parts_(parts) {}

  std::vector<std::size_t> next(std::size_t count) {
    std::vector<std::size_t> shares(parts_, count / parts_);
    for (std::size_t i = count % parts_; i > 0; --i) {
      ++shares[next_];
      next_ = (next_ + 1) % parts_;
    }
    return shares;
  }

 private:
  std::size_t parts_;
  std::size_t next_ = 0;
};

/// A stratum ordered by target, and within a target dealt over its sources: the first problem of
/// each source, the second of each, and so on.
Positions orderedForCutting(const std::vector<PlannedProblem>& problems, const Positions& stratum) {
  std::map<std::pair<std::string, std::string>, std::size_t> seen;
  std::vector<std::tuple<std::string, std::size_t, std::string, std::size_t>> keyed;
  for (const std::size_t position : stratum) {
    const PlannedProblem& c = problems[position];
    keyed.emplace_back(c.problem.target, seen[{c.problem.target, c.problem.source}]++,
                       c.problem.source, position);
  }
  std::sort(keyed.begin(), keyed.end());
  Positions ordered;
  for (const auto& [target, turn, source, position] : keyed) ordered.push_back(position);
  return ordered;
}

/// Sizes that would get less than one in proportion, among those without a share yet: each gets
/// one. Returns whether there were any.
bool ensureMinimumOne(const std::vector<std::size_t>& sizes, std::vector<std::size_t>& shares,
                      std::size_t& count, std::size_t& total) {
  const std::size_t count_before = count;
  const std::size_t total_before = total;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const bool is_small = sizes[i] > 0 && count_before * sizes[i] < total_before;
    if (shares[i] > 0 || !is_small) continue;
    shares[i] = 1;
    --count;
    total -= sizes[i];
  }
  return count != count_before;
}

/// Positions of the nonzero entries, largest first; equal ones in their order.
Positions largestFirst(const std::vector<std::size_t>& values) {
  Positions order;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] > 0) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] > values[b]; });
  return order;
}

}  // namespace

std::vector<std::size_t> allocateProportionally(const std::vector<std::size_t>& sizes,
                                                std::size_t count) {
  std::size_t total = std::accumulate(sizes.begin(), sizes.end(), std::size_t{0});
  if (count > total) {
    throw InvalidParameter("selection: found " + std::to_string(count) +
                           " to share out, expected at most " + std::to_string(total));
  }
  std::vector<std::size_t> shares(sizes.size(), 0);
  const Positions nonempty = largestFirst(sizes);
  if (count <= nonempty.size()) {
    for (std::size_t i = 0; i < count; ++i) shares[nonempty[i]] = 1;
    return shares;
  }
  while (ensureMinimumOne(sizes, shares, count, total)) {
  }
  std::vector<std::size_t> remainders(sizes.size(), 0);
  std::size_t left = count;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (sizes[i] == 0 || shares[i] > 0) continue;
    shares[i] = count * sizes[i] / total;
    remainders[i] = count * sizes[i] % total;
    left -= shares[i];
  }
  const Positions by_remainder = largestFirst(remainders);
  for (std::size_t i = 0; i < left; ++i) ++shares[by_remainder[i]];
  return shares;
}

std::vector<std::size_t> drawSubset(const std::vector<PlannedProblem>& problems, std::size_t count,
                                    std::uint64_t seed) {
  if (count == 0 || count > problems.size()) count = problems.size();
  std::vector<Positions> strata = strataOf(problems);
  // Shuffled, so that ties do not always favour the same sequences.
  Random(streamSeed(seed, "subset")).shuffle(strata);
  std::vector<std::size_t> sizes;
  for (const Positions& stratum : strata) sizes.push_back(stratum.size());
  const std::vector<std::size_t> shares = allocateProportionally(sizes, count);
  Positions chosen;
  for (std::size_t i = 0; i < strata.size(); ++i) {
    Random random(streamSeed(seed, "subset " + nameOf(problems[strata[i].front()])));
    const Positions drawn = drawFromStratum(problems, strata[i], shares[i], random);
    chosen.insert(chosen.end(), drawn.begin(), drawn.end());
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

std::vector<std::size_t> selectShard(const std::vector<PlannedProblem>& problems, std::size_t shard,
                                     std::size_t shards) {
  if (shard >= shards) {
    throw InvalidParameter("shard: found " + std::to_string(shard) + " of " +
                           std::to_string(shards) + ", expected a number below that of shards");
  }
  ShareAllocator allocator(shards);
  Positions taken;
  for (const Positions& stratum : strataOf(problems)) {
    const Positions ordered = orderedForCutting(problems, stratum);
    const std::vector<std::size_t> shares = allocator.next(ordered.size());
    const auto part = shares.begin() + static_cast<std::ptrdiff_t>(shard);
    const auto first = ordered.begin() + static_cast<std::ptrdiff_t>(
                                             std::accumulate(shares.begin(), part, std::size_t{0}));
    taken.insert(taken.end(), first, first + static_cast<std::ptrdiff_t>(*part));
  }
  std::sort(taken.begin(), taken.end());
  return taken;
}

}  // namespace pcrb
