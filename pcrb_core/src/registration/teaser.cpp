// TEASER on matched FPFH features, with known scale. Source: Yang, Shi, Carlone, TEASER: Fast and
// certifiable point cloud registration, T-RO 2021. Certification is not part of it.

#include <cmath>

#include "pcrb_core/parallel.hpp"
#include "pcrb_core/registration/registry.hpp"
#include "registration/features.hpp"
#include "registration/teaser_steps.hpp"

namespace pcrb {
namespace {

constexpr std::size_t kMinInliers = 3;  // matches that fix a pose

struct TeaserParameters : FeatureParameters {
  explicit TeaserParameters(ParameterReader& reader)
      : FeatureParameters(reader),
        noise_bound_leaves(reader.positive("noise_bound_leaves", 1.0)),
        max_clique_work(reader.number("max_clique_work", 1e9, 1.0)),
        max_iterations(reader.integer("max_iterations", 100, 1)) {}

  double noiseBound() const { return noise_bound_leaves * voxel_leaf; }

  double noise_bound_leaves;  ///< ε, of the error of a match, × voxel_leaf
  double max_clique_work;     ///< words of bit sets that the exact clique search may touch
  int max_iterations;         ///< of the rotation's estimation
};

/// Matches are neighbours where their distance is the same in both clouds, up to the noise of two.
Graph compatibility(const Matches& matches, double noise_bound, int threads) {
  Graph graph(matches.size());
  const auto tolerance = static_cast<float>(2.0 * noise_bound);
  forBlocks(matches.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t j = 0; j < matches.size(); ++j) {
        const float a = (matches.source[i] - matches.source[j]).norm();
        const float b = (matches.target[i] - matches.target[j]).norm();
        if (i != j && std::abs(b - a) <= tolerance) graph.setBit(i, j);
      }
    }
  });
  return graph;
}

Matches chosen(const Matches& matches, const std::vector<std::size_t>& indices) {
  Matches result;
  for (const std::size_t i : indices) {
    result.source.push_back(matches.source[i]);
    result.target.push_back(matches.target[i]);
  }
  return result;
}

Eigen::Vector3d estimateTranslation(const Matches& matches, const Eigen::Matrix3d& R,
                                    double noise_bound) {
  Eigen::Vector3d t;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (std::size_t i = 0; i < matches.size(); ++i) {
      const Eigen::Vector3d rotated = R * matches.source[i].cast<double>();
      values.push_back(static_cast<double>(matches.target[i][axis]) - rotated[axis]);
    }
    t[axis] = estimateNumber(values, noise_bound);
  }
  return t;
}

class Teaser : public Registration {
 public:
  explicit Teaser(ParameterReader& reader) : parameters_(reader), matcher_(parameters_) {}

 protected:
  void prepareTarget(const PointCloud& target) override { matcher_.setTarget(target.points); }

  RegistrationResult alignSource(const PointCloud& source, const Transform&) override {
    const Matches matches = matcher_.match(source.points);
    const double bound = parameters_.noiseBound();
    const Clique clique = maximumClique(compatibility(matches, bound, parameters_.threads),
                                        parameters_.max_clique_work);
    if (clique.nodes.size() < kMinInliers) {
      throw RegistrationFailed("found no 3 matches that are compatible with each other");
    }
    const Matches inliers = chosen(matches, clique.nodes);
    const RobustRotation rotation =
        estimateRotation(inliers.source, inliers.target, 2.0 * bound, parameters_.max_iterations,
                         parameters_.threads);
    RegistrationResult result;
    result.T_target_source.linear() = rotation.R;
    result.T_target_source.translation() = estimateTranslation(inliers, rotation.R, bound);
    result.iterations = std::max(rotation.iterations, 1);
    result.converged = clique.is_maximum && rotation.iterations < parameters_.max_iterations;
    if (!clique.is_maximum) {
      result.reason = "the clique search stopped at its limit of work";
    } else if (!result.converged) {
      result.reason = "the rotation stopped at the limit of iterations";
    }
    return result;
  }

 private:
  TeaserParameters parameters_;
  FeatureMatcher matcher_;
};

PCRB_REGISTER_METHOD("teaser", Teaser)

}  // namespace
}  // namespace pcrb
