#pragma once

#include <cstdint>
#include <vector>

#include "pcrb_core/registration/preprocessing.hpp"
#include "pcrb_core/search/kd_tree.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb {

/// Source points that are worked on side by side.
constexpr std::size_t kSourceLanes = 8;

/// The nearest target points of every source point, with one global cut. Exact: searching anew at
/// every call would give the same points.
///
/// A source point keeps more candidates than it needs. While it has moved so little that no target
/// point outside them can have come among its nearest, their distances alone decide.
class PpcrAssociation {
 public:
  /// Pairs in blocks of kSourceLanes source points: entry (block · neighbors + k) · kSourceLanes +
  /// lane is the k-th nearest target point of source point block · kSourceLanes + lane.
  struct Pairs {
    std::vector<float> x, y, z;             ///< m, the target point
    std::vector<float> kept;                ///< 1, or 0 for what is cut off or padding
    std::vector<std::uint32_t> candidates;  ///< index of the target point
  };

  /// @param neighbors     per source point; fewer where the target has fewer.
  /// @param cut_quantile  in (0, 1]: pairs beyond this quantile of all squared distances are cut.
  /// @param radius        m: pairs beyond are cut; infinite for none.
  PpcrAssociation(const KdTree& target, std::size_t source_size, std::size_t neighbors,
                  double cut_quantile, double radius, int threads);

  /// Associates the source at a new pose.
  ///
  /// @return whether a pair changed.
  bool update(const Points& moved_source);

  const Pairs& pairs() const { return pairs_; }
  std::size_t neighbors() const { return neighbors_; }
  std::size_t blocks() const { return (source_size_ + kSourceLanes - 1) / kSourceLanes; }

 private:
  void findNearest(std::size_t point, const Eigen::Vector3f& position,
                   std::vector<Neighbor>& nearest);
  bool recall(std::size_t point, const Eigen::Vector3f& position,
              std::vector<Neighbor>& nearest) const;
  void search(std::size_t point, const Eigen::Vector3f& position, std::vector<Neighbor>& nearest);
  bool store(std::size_t point, const std::vector<Neighbor>& nearest);
  float cutLimit();
  bool cut(float squared_limit);

  const KdTree& target_;
  std::size_t source_size_;
  std::size_t neighbors_;
  std::size_t remembered_;  // candidates per source point
  double cut_quantile_;
  float squared_radius_;
  int threads_;

  Pairs pairs_;
  std::vector<float> squared_distances_;  // of pairs_; infinite for padding
  std::vector<float> scratch_;

  std::vector<std::uint32_t> candidates_;  // source_size_ × remembered_
  std::vector<Eigen::Vector3f> anchors_;   // where a source point was at its last search
  std::vector<float> reach_;               // m: all other target points were this far from it
};

/// E and M steps for one association. Source: Agamennoni, Fontana, Siegwart, Sorrenti, Point clouds
/// registration with probabilistic data association, IROS 2016; ν = 5 degrees of freedom.
class PpcrSolver {
 public:
  struct Solution {
    Transform T_target_source = Transform::Identity();
    double first_cost = 0.0;  ///< Σ w ρ(s), before the first step
    double cost = 0.0;        ///< after the last one
    int iterations = 0;
  };

  /// @param source  m; kept as a copy.
  /// @param robust  ρ(s) = 2(√(1 + s) − 1) in the M step; else ρ(s) = s.
  PpcrSolver(const Points& source, bool robust, int threads);

  /// Alternates E and M from a pose until the relative change of the cost is below `tolerance`.
  ///
  /// @throws RegistrationFailed  if no pair is left.
  Solution solve(const PpcrAssociation& association, const Transform& start, double tolerance,
                 int max_iterations) const;

 private:
  struct Moments;  // of the weighted pairs
  Moments expectation(const PpcrAssociation& association, const Transform& T) const;

  std::vector<Eigen::Vector3d> source_;
  bool robust_;
  int threads_;
};

}  // namespace pcrb
