#include <algorithm>
#include <numeric>

#include "registration/teaser_steps.hpp"

namespace pcrb {
namespace {

using Bits = std::vector<std::uint64_t>;
using Nodes = std::vector<std::size_t>;

std::size_t lowestBit(std::uint64_t word) {
  return static_cast<std::size_t>(__builtin_ctzll(word));
}

std::size_t countBits(const std::uint64_t* row, std::size_t words) {
  std::size_t count = 0;
  for (std::size_t w = 0; w < words; ++w) {
    count += static_cast<std::size_t>(__builtin_popcountll(row[w]));
  }
  return count;
}

template <class Visit>
void forEachBit(const std::uint64_t* row, std::size_t words, const Visit& visit) {
  for (std::size_t w = 0; w < words; ++w) {
    for (std::uint64_t word = row[w]; word != 0; word &= word - 1) {
      visit(64 * w + lowestBit(word));
    }
  }
}

/// Nodes in the order in which they are removed when always one of least degree goes next, and
/// their core numbers.
struct Cores {
  Nodes order;
  Nodes core;
};

/// Nodes sorted by degree, in which a node's degree can be lowered by one.
class DegreeOrder {
 public:
  explicit DegreeOrder(const Graph& graph)
      : degree_(graph.size()), place_(graph.size()), first_(graph.size() + 1, 0) {
    for (std::size_t v = 0; v < graph.size(); ++v) {
      degree_[v] = countBits(graph.row(v), graph.words());
      ++first_[degree_[v]];
    }
    std::exclusive_scan(first_.begin(), first_.end(), first_.begin(), std::size_t{0});
    order_.resize(graph.size());
    Nodes next = first_;
    for (std::size_t v = 0; v < graph.size(); ++v) {
      place_[v] = next[degree_[v]]++;
      order_[place_[v]] = v;
    }
  }

  std::size_t at(std::size_t place) const { return order_[place]; }
  std::size_t degree(std::size_t v) const { return degree_[v]; }
  const Nodes& order() const { return order_; }

  /// Swaps a node with the first of its degree and moves that degree's start behind it.
  void lower(std::size_t v) {
    const std::size_t to = first_[degree_[v]]++;
    const std::size_t other = order_[to];
    std::swap(order_[to], order_[place_[v]]);
    std::swap(place_[v], place_[other]);
    --degree_[v];
  }

 private:
  Nodes degree_;
  Nodes order_;
  Nodes place_;  // of a node in order_
  Nodes first_;  // place of the first node of a degree
};

Cores decompose(const Graph& graph) {
  DegreeOrder nodes(graph);
  for (std::size_t place = 0; place < graph.size(); ++place) {
    const std::size_t v = nodes.at(place);
    forEachBit(graph.row(v), graph.words(), [&](std::size_t u) {
      if (nodes.degree(u) > nodes.degree(v)) nodes.lower(u);
    });
  }
  Cores cores{nodes.order(), Nodes(graph.size())};
  for (std::size_t v = 0; v < graph.size(); ++v) cores.core[v] = nodes.degree(v);
  return cores;
}

/// The part of a graph whose nodes are given, renumbered in their order.
Graph subgraph(const Graph& graph, const Nodes& nodes) {
  constexpr std::size_t kAbsent = ~std::size_t{0};
  Nodes number(graph.size(), kAbsent);
  for (std::size_t i = 0; i < nodes.size(); ++i) number[nodes[i]] = i;
  Graph part(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    forEachBit(graph.row(nodes[i]), graph.words(), [&](std::size_t u) {
      if (number[u] != kAbsent) part.setBit(i, number[u]);
    });
  }
  return part;
}

/// Grows a clique from each of the first nodes, always by the lowest node that fits.
Nodes greedyClique(const Graph& graph) {
  constexpr std::size_t kMaxStarts = 100;
  Nodes best;
  for (std::size_t start = 0; start < std::min(graph.size(), kMaxStarts); ++start) {
    Nodes clique{start};
    Bits candidates(graph.row(start), graph.row(start) + graph.words());
    for (std::size_t w = 0; w < candidates.size(); ++w) {
      while (candidates[w] != 0) {
        const std::size_t v = 64 * w + lowestBit(candidates[w]);
        clique.push_back(v);
        const std::uint64_t* row = graph.row(v);
        for (std::size_t x = w; x < candidates.size(); ++x) candidates[x] &= row[x];
      }
    }
    if (clique.size() > best.size()) best = clique;
  }
  return best;
}

Nodes renamed(const Nodes& numbers, const Nodes& names) {
  Nodes result;
  for (const std::size_t number : numbers) result.push_back(names[number]);
  std::sort(result.begin(), result.end());
  return result;
}

class BranchAndBound {
 public:
  BranchAndBound(const Graph& graph, std::size_t bound, double max_work)
      : graph_(graph), words_(graph.words()), best_size_(bound), work_left_(max_work) {}

  /// A clique larger than the bound; empty where there is none.
  Nodes run() {
    Bits all(words_, 0);
    for (std::size_t v = 0; v < graph_.size(); ++v) all[v / 64] |= std::uint64_t{1} << (v % 64);
    expand(all);
    return best_;
  }

  bool finished() const { return work_left_ > 0.0; }

 private:
  /// Nodes that may extend the current clique to a larger one, with the size that they and those
  /// before them can add at most.
  struct Branches {
    Nodes nodes;
    std::vector<std::size_t> colors;
  };

  Branches color(const Bits& candidates) {
    Branches branches;
    const std::size_t needed = best_size_ >= current_.size() ? best_size_ - current_.size() : 0;
    Bits uncolored = candidates;
    Bits free;
    for (std::size_t color = 1; countBits(uncolored.data(), words_) > 0; ++color) {
      free = uncolored;
      for (std::size_t w = 0; w < words_; ++w) {
        while (free[w] != 0) {
          const std::size_t v = 64 * w + lowestBit(free[w]);
          free[w] &= free[w] - 1;
          uncolored[w] &= ~(std::uint64_t{1} << (v % 64));
          const std::uint64_t* row = graph_.row(v);
          for (std::size_t x = w; x < words_; ++x) free[x] &= ~row[x];
          work_left_ -= static_cast<double>(words_ - w);
          if (color > needed) {
            branches.nodes.push_back(v);
            branches.colors.push_back(color);
          }
        }
      }
      work_left_ -= static_cast<double>(2 * words_);
    }
    return branches;
  }

  void expand(Bits& candidates) {
    const Branches branches = color(candidates);
    Bits next(words_);
    for (std::size_t b = branches.nodes.size(); b-- > 0 && work_left_ > 0.0;) {
      if (current_.size() + branches.colors[b] <= best_size_) return;
      const std::size_t v = branches.nodes[b];
      const std::uint64_t* row = graph_.row(v);
      for (std::size_t w = 0; w < words_; ++w) next[w] = candidates[w] & row[w];
      current_.push_back(v);
      if (countBits(next.data(), words_) > 0) {
        expand(next);
      } else if (current_.size() > best_size_) {
        best_size_ = current_.size();
        best_ = current_;
      }
      current_.pop_back();
      candidates[v / 64] &= ~(std::uint64_t{1} << (v % 64));
    }
  }

  const Graph& graph_;
  std::size_t words_;
  std::size_t best_size_;
  double work_left_;
  Nodes current_;
  Nodes best_;
};

}  // namespace

Clique maximumClique(const Graph& graph, double max_work) {
  if (graph.size() == 0) return {{}, true};
  const Cores cores = decompose(graph);
  const Nodes densest_first(cores.order.rbegin(), cores.order.rend());
  const Nodes greedy = greedyClique(subgraph(graph, densest_first));
  Clique clique{renamed(greedy, densest_first), false};

  // A node of a larger clique has a core number of at least this one's size.
  Nodes kept;
  for (const std::size_t v : densest_first) {
    if (cores.core[v] >= greedy.size()) kept.push_back(v);
  }
  const Graph part = subgraph(graph, kept);
  BranchAndBound search(part, greedy.size(), max_work);
  const Nodes larger = search.run();
  if (!larger.empty()) clique.nodes = renamed(larger, kept);
  clique.is_maximum = search.finished();
  return clique;
}

}  // namespace pcrb
