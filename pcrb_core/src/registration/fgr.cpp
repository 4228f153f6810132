// Fast global registration on matched FPFH features. Source: Zhou, Park, Koltun, Fast global
// registration, ECCV 2016. The paper linearises the pose at every step; here the weighted least
// squares of a step are solved exactly, in closed form.

#include <algorithm>
#include <array>
#include <cmath>

#include "pcrb_core/random.hpp"
#include "pcrb_core/registration/registry.hpp"
#include "registration/features.hpp"

namespace pcrb {
namespace {

constexpr std::size_t kTuple = 3;

struct FgrParameters : FeatureParameters {
  explicit FgrParameters(ParameterReader& reader)
      : FeatureParameters(reader),
        tuple_similarity(reader.number("tuple_similarity", 0.95, 0.0, 1.0)),
        max_tuples(reader.integer("max_tuples", 1000, 1)),
        tuple_trials(reader.integer("tuple_trials", 100, 1)),
        annealing_factor(reader.number("annealing_factor", 1.4, 1.01, 100.0)),
        steps_per_scale(reader.integer("steps_per_scale", 4, 1)),
        distance_leaves(reader.positive("distance_leaves", 1.0)),
        seed(reader.seed("seed", 1)) {}

  double tuple_similarity;  ///< shorter by longer of two corresponding edges at least
  int max_tuples;           ///< that are used at most
  int tuple_trials;         ///< random tuples at most, × matches
  double annealing_factor;  ///< the scale is divided by it
  int steps_per_scale;      ///< between two divisions
  double distance_leaves;   ///< maximum correspondence distance δ, × voxel_leaf
  std::uint64_t seed;
};

/// Matches of the tuples that pass the tuple test (section 4 of the paper); a match may come
/// several times.
class TupleTest {
 public:
  TupleTest(const Matches& matches, const FgrParameters& parameters)
      : matches_(matches), parameters_(parameters) {}

  Matches run() const {
    Random random(parameters_.seed);
    Matches passed;
    const auto needed = kTuple * static_cast<std::size_t>(parameters_.max_tuples);
    std::size_t trials = static_cast<std::size_t>(parameters_.tuple_trials) * matches_.size();
    for (; trials > 0 && passed.size() < needed; --trials) {
      std::array<std::size_t, kTuple> tuple{};
      for (auto& index : tuple) index = static_cast<std::size_t>(random.below(matches_.size()));
      if (!passes(tuple)) continue;
      for (const std::size_t index : tuple) {
        passed.source.push_back(matches_.source[index]);
        passed.target.push_back(matches_.target[index]);
      }
    }
    if (passed.size() < kTuple) throw RegistrationFailed("found no tuple of matches that agrees");
    return passed;
  }

 private:
  bool passes(const std::array<std::size_t, kTuple>& tuple) const {
    const auto similarity = static_cast<float>(parameters_.tuple_similarity);
    for (std::size_t i = 0; i < kTuple; ++i) {
      const std::size_t a = tuple[i];
      const std::size_t b = tuple[(i + 1) % kTuple];
      if (a == b) return false;
      const float source = (matches_.source[a] - matches_.source[b]).norm();
      const float target = (matches_.target[a] - matches_.target[b]).norm();
      if (!(source > similarity * target && target > similarity * source)) return false;
    }
    return true;
  }

  const Matches& matches_;
  const FgrParameters& parameters_;
};

/// Diagonal of the larger bounding box, m: D of the paper.
double diameter(const Matches& matches) {
  const auto diagonal = [](const Points& points) {
    Eigen::AlignedBox<double, 3> box;
    for (const auto& point : points) box.extend(point.cast<double>());
    return box.diagonal().norm();
  };
  return std::max(diagonal(matches.source), diagonal(matches.target));
}

/// Block coordinate descent on pose and line process with graduated non-convexity (equations 4 to
/// 6).
class Annealing {
 public:
  Annealing(const Matches& matches, const FgrParameters& parameters)
      : matches_(matches), parameters_(parameters), weights_(matches.size(), 1.0) {}

  RegistrationResult run() {
    RegistrationResult result;
    const double delta = parameters_.distance_leaves * parameters_.voxel_leaf;
    const double start = diameter(matches_);
    double scale = start * start;  // μ
    for (bool last = false; !last;) {
      last = scale <= delta * delta;
      scale = std::max(scale, delta * delta);
      for (int step = 0; step < parameters_.steps_per_scale; ++step, ++result.iterations) {
        weigh(result.T_target_source, scale);
        result.T_target_source = fitRigid(matches_, weights_);
      }
      scale /= parameters_.annealing_factor;
    }
    result.converged = agreeing(result.T_target_source, delta) >= kTuple;
    if (!result.converged) result.reason = "fewer than 3 matches agree with the pose";
    return result;
  }

 private:
  double squaredResidual(std::size_t i, const Transform& T) const {
    return (matches_.target[i].cast<double>() - T * matches_.source[i].cast<double>())
        .squaredNorm();
  }

  void weigh(const Transform& T, double scale) {
    for (std::size_t i = 0; i < matches_.size(); ++i) {
      const double line = scale / (scale + squaredResidual(i, T));
      weights_[i] = line * line;
    }
  }

  std::size_t agreeing(const Transform& T, double distance) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < matches_.size(); ++i) {
      if (squaredResidual(i, T) <= distance * distance) ++count;
    }
    return count;
  }

  const Matches& matches_;
  const FgrParameters& parameters_;
  std::vector<double> weights_;  // the line process, squared
};

class Fgr : public Registration {
 public:
  explicit Fgr(ParameterReader& reader) : parameters_(reader), matcher_(parameters_) {}

 protected:
  void prepareTarget(const PointCloud& target) override { matcher_.setTarget(target.points); }

  RegistrationResult alignSource(const PointCloud& source, const Transform&) override {
    const Matches tuples = TupleTest(matcher_.match(source.points), parameters_).run();
    return Annealing(tuples, parameters_).run();
  }

 private:
  FgrParameters parameters_;
  FeatureMatcher matcher_;
};

PCRB_REGISTER_METHOD("fgr", Fgr)

}  // namespace
}  // namespace pcrb
