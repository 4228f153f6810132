#include <algorithm>
#include <map>
#include <utility>

#include "pcrb_core/random.hpp"
#include "run/selection.hpp"

namespace pcrb {
namespace {

using Positions = std::vector<std::size_t>;

/// The problems of one target by source, each source's in the order in which they will be taken.
class TargetProblems {
 public:
  void add(const PlannedProblem& planned, std::size_t position) {
    by_source_[planned.problem.source].emplace_back(planned.key.problem_id, position);
    ++size_;
  }

  /// All problems in random order, as few as possible after one of the same source.
  ///
  /// @param source  that of the problem before; replaced by that of the last one.
  Positions arranged(Random& random, std::string& source) {
    for (auto& [name, problems] : by_source_) {
      std::sort(problems.begin(), problems.end());
      random.shuffle(problems);
    }
    Positions order;
    const std::string* urgent = urgentSource();  // even if the target before ended with it
    while (size_ > 0) {
      source = urgent != nullptr ? *urgent : randomSource(random, source);
      order.push_back(take(source));
      urgent = urgentSource();
      if (urgent != nullptr && *urgent == source) urgent = nullptr;
    }
    return order;
  }

 private:
  /// The source that has more than half of what is left: it must come at every second place.
  const std::string* urgentSource() const {
    for (const auto& [name, problems] : by_source_) {
      if (2 * problems.size() > size_) return &name;
    }
    return nullptr;
  }

  /// The source of a random problem, other than `avoided` where there is one.
  std::string randomSource(Random& random, const std::string& avoided) const {
    const auto found = by_source_.find(avoided);
    const std::size_t others = size_ - (found == by_source_.end() ? 0 : found->second.size());
    if (others == 0) return avoided;
    std::uint64_t rank = random.below(others);
    for (const auto& [name, problems] : by_source_) {
      if (name == avoided) continue;
      if (rank < problems.size()) return name;
      rank -= problems.size();
    }
    return avoided;  // not reached: the ranks of the others end before
  }

  std::size_t take(const std::string& source) {
    auto& problems = by_source_.at(source);
    const std::size_t position = problems.back().second;
    problems.pop_back();
    --size_;
    return position;
  }

  std::map<std::string, std::vector<std::pair<std::string, std::size_t>>> by_source_;
  std::size_t size_ = 0;
};

struct SequenceProblems {
  std::string name;
  std::map<std::string, TargetProblems> by_target;
};

/// Sequences in the order in which the list has them first.
std::vector<SequenceProblems> groupBySequence(const std::vector<PlannedProblem>& problems) {
  std::vector<SequenceProblems> sequences;
  std::map<std::string, std::size_t> index_of;
  for (std::size_t i = 0; i < problems.size(); ++i) {
    const PlannedProblem& c = problems[i];
    const std::string name = c.key.data_set + "/" + c.key.sequence;
    const auto [entry, is_new] = index_of.try_emplace(name, sequences.size());
    if (is_new) sequences.push_back({name, {}});
    sequences[entry->second].by_target[c.problem.target].add(c, i);
  }
  return sequences;
}

}  // namespace

std::vector<std::size_t> secretOrder(const std::vector<PlannedProblem>& problems,
                                     const Secret& secret) {
  Positions order;
  std::string source;
  for (SequenceProblems& sequence : groupBySequence(problems)) {
    Random random(secret.bits("order", sequence.name));
    std::vector<TargetProblems> targets;
    for (auto& [name, of_target] : sequence.by_target) targets.push_back(std::move(of_target));
    random.shuffle(targets);
    for (TargetProblems& target : targets) {
      const Positions arranged = target.arranged(random, source);
      order.insert(order.end(), arranged.begin(), arranged.end());
    }
  }
  return order;
}

}  // namespace pcrb
