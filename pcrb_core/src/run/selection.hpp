#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "pcrb_core/run/run_plan.hpp"

namespace pcrb {

// The functions below return positions in the list that they are given. Which
// problems they choose does not depend on the order of that list.

/// A random part of the problems that stands for all of them: shared among sequences and kinds in
/// proportion to their sizes (allocateProportionally), and within each spread evenly over the pairs
/// of clouds, their perturbations drawn at random.
///
/// @param count  problems to draw; 0, or more than there are, takes all.
/// @param seed   the same seed draws the same problems, on any platform.
/// @return       ascending positions.
std::vector<std::size_t> drawSubset(const std::vector<PlannedProblem>& problems, std::size_t count,
                                    std::uint64_t seed);

/// One of several parts of the problems, for several machines: disjoint, together complete, their
/// sizes one apart at most, in total and per sequence and kind. Problems of one target stay
/// together but for the cuts between parts; those of a target that is cut are dealt evenly by
/// source, so that every part has them from several sources.
///
/// @param shard   0 … shards − 1.
/// @return        ascending positions; none where there are more shards than problems.
/// @throws InvalidParameter  unless shard < shards.
std::vector<std::size_t> selectShard(const std::vector<PlannedProblem>& problems, std::size_t shard,
                                     std::size_t shards);

/// The order in which the problems of a run are served, secret as long as the secret is.
///
/// Sequences come in the order in which the list has them first, each in one piece, and so do its
/// targets, shuffled, each in one piece over both kinds: a target is published once. Within a
/// target the problems are shuffled such that as few as possible follow one of the same source:
/// none where no source has more than half of them (rounded up).
///
/// @return  all positions, in serving order.
std::vector<std::size_t> secretOrder(const std::vector<PlannedProblem>& problems,
                                     const Secret& secret);

/// Shares a number out in proportion to sizes: whole parts first, then one each by largest
/// remainder, ties to the earlier. Every size above 0 gets at least one where the number suffices;
/// where it does not, the largest get one each.
///
/// @param count  at most the sum of the sizes.
/// @throws InvalidParameter  if it is more.
std::vector<std::size_t> allocateProportionally(const std::vector<std::size_t>& sizes,
                                                std::size_t count);

/// The elements of a list at some positions.
template <typename T>
std::vector<T> elementsAt(const std::vector<T>& list, const std::vector<std::size_t>& positions) {
  std::vector<T> elements;
  elements.reserve(positions.size());
  for (const std::size_t position : positions) elements.push_back(list.at(position));
  return elements;
}

}  // namespace pcrb
