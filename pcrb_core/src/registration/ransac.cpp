// RANSAC on matched FPFH features. Source: Fischler, Bolles, Random sample consensus, 1981; the
// comparison of edge lengths before a hypothesis is made is that of Buch et al., Pose estimation
// using local structure-specific shape and appearance context, ICRA 2013.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "pcrb_core/parallel.hpp"
#include "pcrb_core/random.hpp"
#include "pcrb_core/registration/registry.hpp"
#include "registration/features.hpp"

namespace pcrb {
namespace {

constexpr std::size_t kSample = 3;                // matches that fix a pose
constexpr std::size_t kHypothesesPerBlock = 256;  // one random sequence each
constexpr std::size_t kBlocksPerRound = 16;       // between two looks at the confidence

struct RansacParameters : FeatureParameters {
  explicit RansacParameters(ParameterReader& reader)
      : FeatureParameters(reader),
        inlier_distance_leaves(reader.positive("inlier_distance_leaves", 1.5)),
        edge_length_ratio(reader.number("edge_length_ratio", 0.9, 0.0, 1.0)),
        confidence(reader.number("confidence", 0.999, 0.0, 0.999999)),
        max_iterations(reader.integer("max_iterations", 1000000, 1)),
        refinements(reader.integer("refinements", 20, 0)),
        seed(reader.seed("seed", 1)) {}

  double inlier_distance_leaves;  ///< × voxel_leaf
  double edge_length_ratio;       ///< shorter by longer edge of a sample at least
  double confidence;              ///< that a better sample is not missed
  int max_iterations;             ///< samples at most
  int refinements;                ///< fits to the inliers at most, at the end
  std::uint64_t seed;
};

struct Hypothesis {
  Transform T = Transform::Identity();
  std::size_t inliers = 0;
  double squared_sum = 0.0;  // m², of the inliers

  bool betterThan(const Hypothesis& other) const {
    return inliers > other.inliers || (inliers == other.inliers && squared_sum < other.squared_sum);
  }
};

class Search {
 public:
  Search(const Matches& matches, const RansacParameters& parameters)
      : matches_(matches), parameters_(parameters) {
    const double distance = parameters.inlier_distance_leaves * parameters.voxel_leaf;
    squared_distance_ = static_cast<float>(distance * distance);
  }

  RegistrationResult run() {
    Hypothesis best;
    RegistrationResult result;
    const auto limit = static_cast<std::size_t>(parameters_.max_iterations);
    std::size_t tried = 0;
    while (tried < limit && static_cast<double>(tried) < needed(best)) {
      const Hypothesis found = searchRound(tried / kHypothesesPerBlock);
      if (found.betterThan(best)) best = found;
      tried += kBlocksPerRound * kHypothesesPerBlock;
    }
    if (best.inliers < kSample) throw RegistrationFailed("found no sample of matches that agrees");
    result.converged = static_cast<double>(tried) >= needed(best);
    if (!result.converged) result.reason = "stopped at the limit of iterations";
    result.T_target_source = refine(best).T;
    result.iterations = static_cast<int>(std::min(tried, limit));
    return result;
  }

 private:
  /// Samples after which a better one is missed with less than 1 − confidence.
  double needed(const Hypothesis& best) const {
    const double ratio = static_cast<double>(best.inliers) / static_cast<double>(matches_.size());
    const double good = ratio * ratio * ratio;
    if (good <= 0.0) return std::numeric_limits<double>::infinity();
    if (good >= 1.0) return 0.0;
    return std::log(1.0 - parameters_.confidence) / std::log1p(-good);
  }

  Hypothesis searchRound(std::size_t first_block) const {
    std::vector<Hypothesis> found(kBlocksPerRound);
    parallelFor(kBlocksPerRound, parameters_.threads,
                [&](std::size_t block) { found[block] = searchBlock(first_block + block); });
    Hypothesis best;
    for (const auto& hypothesis : found) {
      if (hypothesis.betterThan(best)) best = hypothesis;
    }
    return best;
  }

  Hypothesis searchBlock(std::size_t block) const {
    constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15ULL;  // spreads seeds of blocks
    Random random(parameters_.seed ^ ((block + 1) * kGolden));
    Hypothesis best;
    for (std::size_t i = 0; i < kHypothesesPerBlock; ++i) {
      Matches sample;
      if (!draw(random, sample)) continue;
      const Hypothesis hypothesis = evaluate(fitRigid(sample, std::vector<double>(kSample, 1.0)));
      if (hypothesis.betterThan(best)) best = hypothesis;
    }
    return best;
  }

  bool draw(Random& random, Matches& sample) const {
    std::array<std::size_t, kSample> chosen{};
    for (auto& index : chosen) index = static_cast<std::size_t>(random.below(matches_.size()));
    for (std::size_t i = 0; i < kSample; ++i) {
      const std::size_t a = chosen[i];
      const std::size_t b = chosen[(i + 1) % kSample];
      if (a == b) return false;
      const float source = (matches_.source[a] - matches_.source[b]).norm();
      const float target = (matches_.target[a] - matches_.target[b]).norm();
      const auto ratio = static_cast<float>(parameters_.edge_length_ratio);
      if (!(std::min(source, target) >= ratio * std::max(source, target))) return false;
      sample.source.push_back(matches_.source[a]);
      sample.target.push_back(matches_.target[a]);
    }
    return true;
  }

  Hypothesis evaluate(const Transform& T) const {
    Hypothesis hypothesis;
    hypothesis.T = T;
    const Eigen::Isometry3f moved(T.cast<float>());
    for (std::size_t i = 0; i < matches_.size(); ++i) {
      const float s = (matches_.target[i] - moved * matches_.source[i]).squaredNorm();
      if (s > squared_distance_) continue;
      ++hypothesis.inliers;
      hypothesis.squared_sum += s;
    }
    return hypothesis;
  }

  /// Fits to all inliers while that gives a better hypothesis.
  Hypothesis refine(Hypothesis best) const {
    for (int i = 0; i < parameters_.refinements; ++i) {
      std::vector<double> weights;
      for (std::size_t m = 0; m < matches_.size(); ++m) {
        const Eigen::Vector3d moved = best.T * matches_.source[m].cast<double>();
        const double s = (matches_.target[m].cast<double>() - moved).squaredNorm();
        weights.push_back(s <= squared_distance_ ? 1.0 : 0.0);
      }
      const Hypothesis refined = evaluate(fitRigid(matches_, weights));
      if (!refined.betterThan(best)) break;
      best = refined;
    }
    return best;
  }

  const Matches& matches_;
  const RansacParameters& parameters_;
  float squared_distance_ = 0.0F;  // m²
};

class Ransac : public Registration {
 public:
  explicit Ransac(ParameterReader& reader) : parameters_(reader), matcher_(parameters_) {}

 protected:
  void prepareTarget(const PointCloud& target) override { matcher_.setTarget(target.points); }

  RegistrationResult alignSource(const PointCloud& source, const Transform&) override {
    const Matches matches = matcher_.match(source.points);
    return Search(matches, parameters_).run();
  }

 private:
  RansacParameters parameters_;
  FeatureMatcher matcher_;
};

PCRB_REGISTER_METHOD("ransac", Ransac)

}  // namespace
}  // namespace pcrb
