#pragma once

#include "pcrb_core/transform.hpp"
#include "registration/ppcr_association.hpp"

namespace pcrb {

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
