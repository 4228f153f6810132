#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pcrb_core/registration/preprocessing.hpp"

namespace pcrb {

/// Undirected graph as a bit matrix.
class Graph {
 public:
  explicit Graph(std::size_t size) : size_(size), words_((size + 63) / 64), bits_(size * words_) {}

  std::size_t size() const { return size_; }
  std::size_t words() const { return words_; }  ///< 64-bit words of a row

  void connect(std::size_t a, std::size_t b) {
    setBit(a, b);
    setBit(b, a);
  }
  /// Sets b in a's row only: the caller sets a in b's.
  void setBit(std::size_t a, std::size_t b) {
    bits_[a * words_ + b / 64] |= std::uint64_t{1} << (b % 64);
  }
  bool connected(std::size_t a, std::size_t b) const {
    return ((bits_[a * words_ + b / 64] >> (b % 64)) & 1U) != 0;
  }
  const std::uint64_t* row(std::size_t a) const { return &bits_[a * words_]; }

 private:
  std::size_t size_;
  std::size_t words_;
  std::vector<std::uint64_t> bits_;
};

struct Clique {
  std::vector<std::size_t> nodes;  ///< ascending
  bool is_maximum = false;         ///< proven; else the largest found within the work allowed
};

/// A maximum clique: pruning by cores, a greedy bound, then branch and bound with greedy colouring.
///
/// @param max_work  words of bit sets that the branch and bound may touch, about 1e9 a second: a
///                  limit that, other than one of time, gives the same clique on every machine.
/// Deterministic; ties go to the nodes met first in an order that depends on the graph alone.
/// Sources: Batagelj, Zaversnik, An O(m) algorithm for cores decomposition of networks, 2003;
/// Tomita, Kameda, An efficient branch-and-bound algorithm for finding a maximum clique, 2007; San
/// Segundo et al., An exact bit-parallel algorithm for the maximum clique problem, 2011.
Clique maximumClique(const Graph& graph, double max_work);

// The robust estimators of TEASER: least squares whose residuals count up to a bound only. Source:
// Yang, Shi, Carlone, TEASER: Fast and certifiable point cloud registration, T-RO 2021.

struct RobustRotation {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  int iterations = 0;
};

/// Rotation R with the least Σ min(‖b − R a‖², bound²) by graduated non-convexity. Vectors are the
/// differences of all pairs of points: a of `source`, b of `target`.
///
/// @param bound  m, of the error of a difference.
/// Source: Yang, Antonante, Tzoumas, Carlone, Graduated non-convexity for robust spatial
/// perception, RA-L 2020 (GNC-TLS).
RobustRotation estimateRotation(const Points& source, const Points& target, double bound,
                                int max_iterations, int threads);

/// The number t with the least Σ min((x − t)², bound²), by adaptive voting: exact.
double estimateNumber(const std::vector<double>& values, double bound);

}  // namespace pcrb
