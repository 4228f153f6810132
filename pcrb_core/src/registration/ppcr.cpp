// Probabilistic point clouds registration. Sources: Agamennoni, Fontana, Siegwart, Sorrenti, Point
// clouds registration with probabilistic data association, IROS 2016; Fontana, Sorrenti, A
// termination criterion for probabilistic point clouds registration, 2020.

#include <limits>
#include <optional>

#include "pcrb_core/registration/registry.hpp"
#include "registration/ppcr_steps.hpp"

namespace pcrb {
namespace {

struct PpcrParameters {
  explicit PpcrParameters(ParameterReader& reader)
      : voxel_leaf(reader.number("voxel_leaf", 0.2, 0.0)),
        sampling_fraction(reader.number("sampling_fraction", 0.3, 1e-6, 1.0)),
        neighbors(reader.integer("neighbors", 10, 1, 1000)),
        search_radius(reader.number("search_radius", 0.0, 0.0)),
        cut_quantile(reader.number("cut_quantile", 0.7, 1e-6, 1.0)),
        robust(reader.boolean("robust", true)),
        cost_tolerance(reader.number("cost_tolerance", 1e-5, 0.0, 1.0)),
        inner_iterations(reader.integer("inner_iterations", 100, 1)),
        cost_drop(reader.number("cost_drop", 0.01, 0.0, 1.0)),
        drop_patience(reader.integer("drop_patience", 20, 0)),
        max_iterations(reader.integer("max_iterations", 200, 1)),
        seed(reader.seed("seed", 1)),
        threads(reader.threads()) {}

  Points filter(const Points& points) const {
    return voxel_leaf > 0.0 ? voxelGrid(points, voxel_leaf) : points;
  }

  double voxel_leaf;         ///< m, 0 for none
  double sampling_fraction;  ///< part of the filtered source that is used
  int neighbors;             ///< target points per source point
  double search_radius;      ///< m: pairs beyond are left out; 0 for none
  double cut_quantile;       ///< of all squared distances: pairs beyond are left out
  bool robust;               ///< ρ(s) = 2(√(1 + s) − 1) in the M step, else ρ(s) = s
  double cost_tolerance;     ///< relative change that ends the inner iterations
  int inner_iterations;      ///< at most, for one association
  double cost_drop;          ///< relative decrease of an inner solve that counts as none
  int drop_patience;         ///< consecutive associations without a decrease that are allowed
  int max_iterations;        ///< associations at most
  std::uint64_t seed;        ///< of the subsampling
  int threads;
};

/// When to stop associating. Source: Fontana, Sorrenti 2020.
class Termination {
 public:
  explicit Termination(const PpcrParameters& parameters) : parameters_(parameters) {}

  /// @return whether the cost has stopped decreasing.
  bool afterSolve(const PpcrSolver::Solution& solution) {
    const double drop = solution.first_cost > 0.0
                            ? (solution.first_cost - solution.cost) / solution.first_cost
                            : 0.0;
    steady_ = drop < parameters_.cost_drop ? steady_ + 1 : 0;
    return steady_ > parameters_.drop_patience;
  }

 private:
  const PpcrParameters& parameters_;
  int steady_ = 0;
};

class Ppcr : public Registration {
 public:
  explicit Ppcr(ParameterReader& reader) : parameters_(reader) {}

 protected:
  void prepareTarget(const PointCloud& target) override {
    const Points points = parameters_.filter(target.points);
    requirePoints(points, kMinPoints, "target");
    tree_.emplace(points);
  }

  RegistrationResult alignSource(const PointCloud& source, const Transform& guess) override {
    const Points points = subsample(parameters_.filter(source.points),
                                    parameters_.sampling_fraction, parameters_.seed);
    requirePoints(points, kMinPoints, "source");
    const double radius = parameters_.search_radius > 0.0 ? parameters_.search_radius
                                                          : std::numeric_limits<double>::infinity();
    PpcrAssociation association(*tree_, points.size(),
                                static_cast<std::size_t>(parameters_.neighbors),
                                parameters_.cut_quantile, radius, parameters_.threads);
    return iterate(points, association, guess);
  }

 private:
  static constexpr std::size_t kMinPoints = 10;

  RegistrationResult iterate(const Points& source, PpcrAssociation& association,
                             const Transform& guess) const {
    const PpcrSolver solver(source, parameters_.robust, parameters_.threads);
    Termination termination(parameters_);
    RegistrationResult result;
    result.T_target_source = guess;
    result.reason = "stopped at the limit of iterations";
    bool pose_changed = true;
    while (result.iterations < parameters_.max_iterations && !result.converged) {
      const bool pairs_changed = association.update(moved(source, result.T_target_source));
      result.converged = !pairs_changed && !pose_changed;
      if (result.converged) break;
      const auto solution = solver.solve(association, result.T_target_source,
                                         parameters_.cost_tolerance, parameters_.inner_iterations);
      pose_changed = !samePose(solution.T_target_source, result.T_target_source);
      result.T_target_source = solution.T_target_source;
      ++result.iterations;
      result.converged = termination.afterSolve(solution);
    }
    if (result.converged) result.reason.clear();
    return result;
  }

  static bool samePose(const Transform& a, const Transform& b) {
    constexpr double kRounding = 1e-9;
    return a.isApprox(b, kRounding);
  }

  static Points moved(const Points& points, const Transform& T) {
    Points result;
    result.reserve(points.size());
    for (const auto& point : points) result.push_back((T * point.cast<double>()).cast<float>());
    return result;
  }

  PpcrParameters parameters_;
  std::optional<KdTree> tree_;
};

PCRB_REGISTER_METHOD("ppcr", Ppcr)

}  // namespace
}  // namespace pcrb
