// ICP as the paper runs it, on PCL's IterativeClosestPoint. PCL's loop, median rejector and SVD are
// used as they are; the nearest-neighbour search (in parallel, tree kept with the target) and the
// criterion to stop (movement of the source's centroid, where PCL takes that of the frame's origin)
// are ours. PCL's pointers are boost's before 1.12: only their own types are spelled here.

#include <pcl/registration/correspondence_rejection_median_distance.h>
#include <pcl/registration/icp.h>

#include <memory>
#include <optional>

#include "pcrb_core/registration/registry.hpp"
#include "registration/pcl_common.hpp"

namespace pcrb {
namespace {

using Point = pcl::PointXYZ;
using Criteria = pcl::registration::DefaultConvergenceCriteria<double>;
using MedianRejector = pcl::registration::CorrespondenceRejectorMedianDistance;
using Estimation = pcl::registration::CorrespondenceEstimationBase<Point, Point, double>;

constexpr std::size_t kMinIcpPoints = 10;

class ParallelEstimation : public Estimation {
 public:
  ParallelEstimation(const pcrb::KdTree& target, int threads)
      : tree_of_target_(target), threads_(threads) {}

  void determineCorrespondences(pcl::Correspondences& correspondences, double) override {
    nearestCorrespondences(tree_of_target_, *input_, threads_, correspondences);
  }
  void determineReciprocalCorrespondences(pcl::Correspondences&, double) override {
    throw RegistrationFailed("ICP: reciprocal correspondences are not used here");
  }
  Estimation::Ptr clone() const override { return Estimation::Ptr(new ParallelEstimation(*this)); }

 private:
  const pcrb::KdTree& tree_of_target_;
  int threads_;
};

/// Converged when the source's centroid moved less than a limit in an iteration.
class CentroidCriteria : public Criteria {
 public:
  CentroidCriteria(const int& iterations, const Eigen::Matrix4d& increment,
                   const Eigen::Matrix4d& T_target_source,
                   const pcl::Correspondences& correspondences)
      : Criteria(iterations, increment, correspondences), T_target_source_(T_target_source) {}

  /// @param centroid  m, of the source after the initial guess.
  void start(const Eigen::Vector3d& centroid_of_source, const Eigen::Vector3d& moved_by_guess,
             double epsilon) {
    source_centroid_ = centroid_of_source.homogeneous();
    centroid_ = moved_by_guess.homogeneous();
    epsilon_ = epsilon;
  }

  bool hasConverged() override {
    const Eigen::Vector4d previous = centroid_;
    centroid_ = T_target_source_ * source_centroid_;
    ConvergenceState state = CONVERGENCE_CRITERIA_NOT_CONVERGED;
    if (iterations_ >= max_iterations_) state = CONVERGENCE_CRITERIA_ITERATIONS;
    if ((centroid_ - previous).norm() < epsilon_) state = CONVERGENCE_CRITERIA_TRANSFORM;
    setConvergenceState(state);
    return state != CONVERGENCE_CRITERIA_NOT_CONVERGED;
  }

 private:
  const Eigen::Matrix4d& T_target_source_;
  Eigen::Vector4d source_centroid_ = Eigen::Vector4d::Zero();
  Eigen::Vector4d centroid_ = Eigen::Vector4d::Zero();
  double epsilon_ = 0.0;
};

/// PCL's ICP with our search and our criterion.
class PclIcp : public pcl::IterativeClosestPoint<Point, Point, double> {
 public:
  PclIcp(const IcpParameters& parameters, const pcrb::KdTree& target_tree,
         PclCloud::ConstPtr target) {
    // Our search has its own tree: PCL must not build one.
    setSearchMethodTarget(tree_, true);
    setSearchMethodSource(tree_reciprocal_, true);
    setInputTarget(target);
    correspondence_estimation_.reset(new ParallelEstimation(target_tree, parameters.threads));
    // PCL's distances are squared: so is the factor.
    const MedianRejector::Ptr rejector(new MedianRejector);
    rejector->setMedianFactor(parameters.rejection_factor * parameters.rejection_factor);
    addCorrespondenceRejector(rejector);
    setMaximumIterations(parameters.max_iterations);
    criteria_ = new CentroidCriteria(nr_iterations_, transformation_, final_transformation_,
                                     *correspondences_);
    convergence_criteria_.reset(criteria_);
    epsilon_ = parameters.translation_epsilon;
  }

  RegistrationResult run(const Points& source, const Transform& guess) {
    const auto cloud = toPcl(source);
    setInputSource(cloud);
    const Eigen::Vector3d center = meanOf(source);
    criteria_->start(center, guess * center, epsilon_);
    PclCloud aligned;
    align(aligned, guess.matrix());

    RegistrationResult result;
    result.T_target_source = Transform(final_transformation_);
    result.T_target_source.linear() = nearestRotation(result.T_target_source.linear());
    result.iterations = nr_iterations_;
    result.converged = criteria_->getConvergenceState() == Criteria::CONVERGENCE_CRITERIA_TRANSFORM;
    if (!result.converged) result.reason = "stopped at the limit of iterations";
    return result;
  }

 private:
  CentroidCriteria* criteria_;  // PCL owns it
  double epsilon_ = 0.0;
};

class IcpMethod : public Registration {
 public:
  explicit IcpMethod(ParameterReader& reader) : parameters_(reader) {}

 protected:
  void prepareTarget(const PointCloud& target) override {
    const Points points = parameters_.filterTarget(target.points);
    requirePoints(points, kMinIcpPoints, "target");
    tree_.emplace(points);
    icp_ = std::make_unique<PclIcp>(parameters_, *tree_, toPcl(points));
  }

  RegistrationResult alignSource(const PointCloud& source, const Transform& guess) override {
    const Points points = parameters_.filterSource(source.points);
    requirePoints(points, kMinIcpPoints, "source");
    return icp_->run(points, guess);
  }

 private:
  IcpParameters parameters_;
  std::optional<KdTree> tree_;
  std::unique_ptr<PclIcp> icp_;
};

PCRB_REGISTER_METHOD("icp", IcpMethod)

}  // namespace
}  // namespace pcrb
