#pragma once

// What the methods on PCL share. Slow to compile: for their .cpp files only.

#include <pcl/correspondence.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include "pcrb_core/registration/preprocessing.hpp"
#include "pcrb_core/search/kd_tree.hpp"

namespace pcrb {

using PclCloud = pcl::PointCloud<pcl::PointXYZ>;

PclCloud::Ptr toPcl(const Points& points);

/// For each point of `source` the nearest of the tree, with the squared distance (m²) as PCL's
/// `distance`.
void nearestCorrespondences(const KdTree& target, const PclCloud& source, int threads,
                            pcl::Correspondences& correspondences);

}  // namespace pcrb
