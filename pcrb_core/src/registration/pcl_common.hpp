#pragma once

// What the methods on PCL share. Slow to compile: for their .cpp files only.

#include <pcl/console/print.h>
#include <pcl/correspondence.h>
#include <pcl/pcl_config.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cstdint>

#include "pcrb_core/registration/parameters.hpp"
#include "pcrb_core/registration/preprocessing.hpp"
#include "pcrb_core/search/kd_tree.hpp"

namespace pcrb {

using PclCloud = pcl::PointCloud<pcl::PointXYZ>;

/// Scalar of PCL's G-ICP and NDT: before 1.13 they know float only (docs/platforms.md).
#if PCL_VERSION_COMPARE(>=, 1, 13, 0)
using PclScalar = double;
#else
using PclScalar = float;
#endif
using PclMatrix4 = Eigen::Matrix<PclScalar, 4, 4>;

/// PCL prints warnings about single cells; the library prints nothing.
class QuietPcl {
 public:
  QuietPcl() { pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS); }
  ~QuietPcl() { pcl::console::setVerbosityLevel(level_); }
  QuietPcl(const QuietPcl&) = delete;
  QuietPcl& operator=(const QuietPcl&) = delete;

 private:
  pcl::console::VERBOSITY_LEVEL level_ = pcl::console::getVerbosityLevel();
};

PclCloud::Ptr toPcl(const Points& points);

/// For each point of `source` the nearest of the tree, with the squared distance (m²) as PCL's
/// `distance`.
void nearestCorrespondences(const KdTree& target, const PclCloud& source, int threads,
                            pcl::Correspondences& correspondences);

/// What ICP and G-ICP read alike; the paper's values are the defaults.
struct IcpParameters {
  explicit IcpParameters(ParameterReader& reader);

  Points filterTarget(const Points& points) const;
  Points filterSource(const Points& points) const;

  double voxel_leaf;           ///< m
  double sampling_fraction;    ///< part of the filtered source that is used
  double rejection_factor;     ///< × the median distance; pairs beyond are left out
  int max_iterations;          ///< then the method stops unconverged
  double translation_epsilon;  ///< m, at the source's centroid; a smaller step is convergence
  std::uint64_t seed;          ///< of the subsampling
  int threads;
};

}  // namespace pcrb
