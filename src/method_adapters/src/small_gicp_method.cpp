// small_gicp's GICP and VGICP as methods of the benchmark. The library prints warnings for clouds
// that are too small; here they are errors before it sees them.

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

// The library's headers take some of the standard library for included.
#include <small_gicp/ann/gaussian_voxelmap.hpp>
#include <small_gicp/ann/kdtree.hpp>
#include <small_gicp/factors/gicp_factor.hpp>
#include <small_gicp/points/point_cloud.hpp>
#include <small_gicp/registration/reduction.hpp>
#include <small_gicp/registration/registration.hpp>
#include <small_gicp/util/downsampling.hpp>
#include <small_gicp/util/normal_estimation.hpp>
#ifdef _OPENMP
#include <omp.h>

#include <small_gicp/registration/reduction_omp.hpp>
#endif

#include "pcrb_core/registration/registry.hpp"

namespace {

using Tree = small_gicp::KdTree<small_gicp::PointCloud>;
using Cloud = std::shared_ptr<small_gicp::PointCloud>;

struct Settings {
  explicit Settings(pcrb::ParameterReader& reader)
      : voxel_leaf(reader.positive("voxel_leaf", 0.2)),
        neighbors(reader.integer("covariance_neighbors", 10, 4, 1000)),
        max_iterations(reader.integer("max_iterations", 20, 1)),
        translation_epsilon(reader.positive("translation_epsilon", 1e-3)),
        rotation_epsilon(reader.positive("rotation_epsilon_deg", 0.1) * M_PI / 180.0),
        threads(reader.integer("threads", 1, 1, 256)) {}

  double voxel_leaf;  // m
  int neighbors;      // that give a point's covariance
  int max_iterations;
  double translation_epsilon;  // m
  double rotation_epsilon;     // rad
  int threads;
};

/// A filtered cloud with covariances.
Cloud prepare(const pcrb::PointCloud& cloud, const Settings& settings, const char* what) {
  Cloud filtered =
      small_gicp::voxelgrid_sampling(small_gicp::PointCloud(cloud.points), settings.voxel_leaf);
  const std::size_t least = static_cast<std::size_t>(std::max(settings.neighbors, 11));
  if (filtered->size() < least) {
    throw pcrb::InvalidProblem(std::string(what) + ": found " + std::to_string(filtered->size()) +
                               " points after the voxel grid, expected at least " +
                               std::to_string(least));
  }
  small_gicp::estimate_covariances(*filtered, settings.neighbors);
  return filtered;
}

template <class Reduction, class Target, class Search>
small_gicp::RegistrationResult run(Reduction reduction, const Settings& settings,
                                   double max_distance, const Target& target, const Search& search,
                                   const small_gicp::PointCloud& source,
                                   const pcrb::Transform& guess) {
  small_gicp::Registration<small_gicp::GICPFactor, Reduction> registration;
  registration.reduction = reduction;
  registration.rejector.max_dist_sq = max_distance * max_distance;
  registration.criteria.translation_eps = settings.translation_epsilon;
  registration.criteria.rotation_eps = settings.rotation_epsilon;
  registration.optimizer.max_iterations = settings.max_iterations;
  return registration.align(target, source, search, guess);
}

template <class Target, class Search>
pcrb::RegistrationResult solve(const Settings& settings, double max_distance, const Target& target,
                               const Search& search, const pcrb::PointCloud& source,
                               const pcrb::Transform& guess) {
  const Cloud moved = prepare(source, settings, "source");
  small_gicp::RegistrationResult found;
#ifdef _OPENMP
  if (settings.threads > 1) {
    small_gicp::ParallelReductionOMP reduction;
    reduction.num_threads = settings.threads;
    found = run(reduction, settings, max_distance, target, search, *moved, guess);
  } else
#endif
    found =
        run(small_gicp::SerialReduction(), settings, max_distance, target, search, *moved, guess);
  if (found.num_inliers == 0)
    throw pcrb::RegistrationFailed("no point of the source is near one of the target");
  pcrb::RegistrationResult result;
  result.T_target_source = found.T_target_source;
  result.converged = found.converged;
  if (!found.converged) result.reason = "stopped at the limit of iterations";
  result.iterations = static_cast<int>(found.iterations) + 1;  // it counts from 0
  return result;
}

class SmallGicp : public pcrb::Registration {
 public:
  explicit SmallGicp(pcrb::ParameterReader& reader)
      : settings_(reader), max_distance_(reader.positive("max_correspondence_distance", 1.0)) {}

 protected:
  void prepareTarget(const pcrb::PointCloud& target) override {
    target_ = prepare(target, settings_, "target");
    tree_ = std::make_unique<Tree>(target_);
  }

  pcrb::RegistrationResult alignSource(const pcrb::PointCloud& source,
                                       const pcrb::Transform& guess) override {
    return solve(settings_, max_distance_, *target_, *tree_, source, guess);
  }

 private:
  Settings settings_;
  double max_distance_;  // m
  Cloud target_;
  std::unique_ptr<Tree> tree_;
};

class SmallVgicp : public pcrb::Registration {
 public:
  explicit SmallVgicp(pcrb::ParameterReader& reader)
      : settings_(reader), map_leaf_(reader.positive("map_leaf", 1.0)) {}

 protected:
  void prepareTarget(const pcrb::PointCloud& target) override {
    map_ = std::make_unique<small_gicp::GaussianVoxelMap>(map_leaf_);
    map_->insert(*prepare(target, settings_, "target"));
  }

  pcrb::RegistrationResult alignSource(const pcrb::PointCloud& source,
                                       const pcrb::Transform& guess) override {
    return solve(settings_, 2.0 * map_leaf_, *map_, *map_, source, guess);
  }

 private:
  Settings settings_;
  double map_leaf_;  // m
  std::unique_ptr<small_gicp::GaussianVoxelMap> map_;
};

PCRB_REGISTER_METHOD("small_gicp", SmallGicp)
PCRB_REGISTER_METHOD("small_vgicp", SmallVgicp)

}  // namespace
