// PCL's ICP, G-ICP and NDT as they are, with the paper's numbers typed in: what the paper's rows of
// these methods probably are (docs/methods.md). icp.cpp, gicp.cpp and ndt.cpp do what its text
// says.

#include <pcl/registration/correspondence_rejection_median_distance.h>
#include <pcl/registration/gicp.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/ndt.h>

#include <memory>

#include "pcrb_core/registration/registry.hpp"
#include "registration/pcl_common.hpp"

namespace pcrb {
namespace {

using PlainPoint = pcl::PointXYZ;
constexpr std::size_t kMinPlainPoints = 10;

/// A class of PCL that says how many iterations it took.
template <class PclMethod>
class Counting : public PclMethod {
 public:
  int iterations() const { return this->nr_iterations_; }
};

/// Runs one of PCL's methods whose target is set, and takes its word for having converged.
template <class PclMethod>
RegistrationResult runPlainPcl(Counting<PclMethod>& method, const Points& source,
                               const Transform& guess) {
  method.setInputSource(toPcl(source));
  PclCloud aligned;
  method.align(aligned, guess.matrix().cast<float>());
  RegistrationResult result;
  result.T_target_source =
      Transform(Eigen::Matrix4d(method.getFinalTransformation().template cast<double>()));
  result.T_target_source.linear() = nearestRotation(result.T_target_source.linear());
  result.iterations = method.iterations();
  result.converged = method.hasConverged();
  if (!result.converged) result.reason = "PCL says that it did not converge";
  return result;
}

/// ICP and G-ICP, which read alike; G-ICP ignores the rejector.
template <class PclMethod, int kLeastPoints>
class PlainIcp : public Registration {
 public:
  explicit PlainIcp(ParameterReader& reader) : parameters_(reader) {
    const pcl::registration::CorrespondenceRejectorMedianDistance::Ptr rejector(
        new pcl::registration::CorrespondenceRejectorMedianDistance);
    rejector->setMedianFactor(parameters_.rejection_factor);
    method_.addCorrespondenceRejector(rejector);
    method_.setMaximumIterations(parameters_.max_iterations);
    method_.setTransformationEpsilon(parameters_.translation_epsilon);
  }

 protected:
  void prepareTarget(const PointCloud& target) override {
    const Points points = parameters_.filterTarget(target.points);
    requirePoints(points, kLeastPoints, "target");
    method_.setInputTarget(toPcl(points));
  }

  RegistrationResult alignSource(const PointCloud& source, const Transform& guess) override {
    const QuietPcl quiet;
    const Points points = parameters_.filterSource(source.points);
    requirePoints(points, kLeastPoints, "source");
    return runPlainPcl(method_, points, guess);
  }

 private:
  IcpParameters parameters_;
  Counting<PclMethod> method_;
};

/// NDT with the line search of its own, on clouds that are not filtered.
class PlainNdt : public Registration {
 public:
  explicit PlainNdt(ParameterReader& reader) {
    method_.setResolution(static_cast<float>(reader.positive("voxel_leaf", 0.2)));
    method_.setStepSize(reader.positive("max_step", 0.1));
    method_.setMaximumIterations(reader.integer("max_iterations", 35, 1));
    method_.setTransformationEpsilon(reader.number("translation_epsilon", 0.01, 0.0));
    reader.threads();  // accepted as with every method; PCL's NDT runs on one core
  }

 protected:
  void prepareTarget(const PointCloud& target) override {
    const QuietPcl quiet;
    requirePoints(target.points, kMinPlainPoints, "target");
    method_.setInputTarget(toPcl(target.points));
    if (!method_.hasCells()) {
      throw InvalidProblem(
          "target: found no cell with 6 points (or more cells than PCL can number), expected one");
    }
  }

  RegistrationResult alignSource(const PointCloud& source, const Transform& guess) override {
    const QuietPcl quiet;
    requirePoints(source.points, kMinPlainPoints, "source");
    return runPlainPcl(method_, source.points, guess);
  }

 private:
  class Ndt : public Counting<pcl::NormalDistributionsTransform<PlainPoint, PlainPoint>> {
   public:
    bool hasCells() {  // not const, as what it asks is not
      const auto cells = target_cells_.getCentroids();
      return cells != nullptr && !cells->empty();
    }
  };
  Ndt method_;
};

using IcpPcl = PlainIcp<pcl::IterativeClosestPoint<PlainPoint, PlainPoint>, kMinPlainPoints>;
using GicpPcl = PlainIcp<pcl::GeneralizedIterativeClosestPoint<PlainPoint, PlainPoint>, 20>;

PCRB_REGISTER_METHOD("icp_pcl", IcpPcl)
PCRB_REGISTER_METHOD("gicp_pcl", GicpPcl)
PCRB_REGISTER_METHOD("ndt_pcl", PlainNdt)

}  // namespace
}  // namespace pcrb
