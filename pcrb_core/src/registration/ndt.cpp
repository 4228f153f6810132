// NDT as the paper runs it, on PCL's NormalDistributionsTransform. PCL's cells, derivatives and
// line search are used as they are; the outer loop is PCL's too, written again here because its
// test for convergence takes the translation at the frame's origin, not at the source's centroid.

#include <pcl/common/transforms.h>
#include <pcl/registration/ndt.h>

#include <cmath>
#include <memory>
#include <vector>

#include "pcrb_core/registration/registry.hpp"
#include "registration/pcl_common.hpp"

namespace pcrb {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr std::size_t kMinNdtPoints = 10;

struct NdtParameters {
  explicit NdtParameters(ParameterReader& reader)
      : voxel_leaf(reader.positive("voxel_leaf", 0.2)),
        levels(reader.integer("levels", 1, 1, 10)),
        filter_source(reader.boolean("filter_source", true)),
        source_leaf(reader.number("source_leaf", 0.0, 0.0)),
        max_step(reader.positive("max_step", 0.1)),
        outlier_ratio(reader.number("outlier_ratio", 0.55, 0.01, 0.99)),
        min_points_per_cell(reader.integer("min_points_per_cell", 6, 3)),
        max_iterations(reader.integer("max_iterations", 35, 1)),
        translation_epsilon(reader.number("translation_epsilon", 0.01, 0.0)) {
    reader.threads();  // accepted as with every method; PCL's NDT runs on one core
  }

  /// Edge of the target's cells at a level, 0 being the finest; m.
  double leafOf(int level) const { return voxel_leaf * std::pow(2.0, level); }
  double leafOfSource() const { return source_leaf > 0.0 ? source_leaf : voxel_leaf; }

  double voxel_leaf;           ///< m, edge of the target's smallest cells
  int levels;                  ///< sizes of cells, each twice the next one
  bool filter_source;          ///< through a voxel grid
  double source_leaf;          ///< m, of that voxel grid; 0 = voxel_leaf
  double max_step;             ///< of the line search: norm of (m, rad) at most
  double outlier_ratio;        ///< part of the points that the mixture takes for outliers
  int min_points_per_cell;     ///< cells with fewer have no distribution
  int max_iterations;          ///< then the method stops unconverged
  double translation_epsilon;  ///< m, at the source's centroid; a smaller step is convergence
};

#if PCL_VERSION_COMPARE(>=, 1, 13, 0)
using PclNdtBase = pcl::NormalDistributionsTransform<pcl::PointXYZ, pcl::PointXYZ, double>;
#else
using PclNdtBase = pcl::NormalDistributionsTransform<pcl::PointXYZ, pcl::PointXYZ>;
#endif

class PclNdt : public PclNdtBase {
 public:
  PclNdt(const NdtParameters& parameters, double leaf, const Points& target)
      : parameters_(parameters) {
    const QuietPcl quiet;
    setResolution(static_cast<float>(leaf));
    target_cells_.setMinPointPerVoxel(parameters.min_points_per_cell);
    outlier_ratio_ = parameters.outlier_ratio;  // whose setter has two spellings
    setInputTarget(toPcl(target));
    if (target_cells_.getCentroids() == nullptr || target_cells_.getCentroids()->empty()) {
      throw InvalidProblem("target: found no cell of " + std::to_string(leaf) + " m with " +
                           std::to_string(parameters.min_points_per_cell) +
                           " points (or more cells than PCL can number), expected at least one");
    }
  }

  RegistrationResult run(const Points& source, const Transform& guess) {
    setInputSource(toPcl(source));
    source_centroid_ = meanOf(source);
    result_ = {};
    PclCloud aligned;
    align(aligned, guess.matrix().cast<PclScalar>());
    result_.T_target_source = pose();
    result_.T_target_source.linear() = nearestRotation(result_.T_target_source.linear());
    return result_;
  }

 protected:
  /// Algorithm 2 of Magnusson, The three-dimensional normal-distributions transform, 2009.
  void computeTransformation(PclCloud& moved, const PclMatrix4& guess) override {
    prepareMixture();
    final_transformation_ = guess;
    pcl::transformPointCloud(*input_, moved, guess);
    const Transform start(Eigen::Matrix4d(guess.cast<double>()));
    Vector6d parameters;
    parameters << start.translation(), start.rotation().eulerAngles(0, 1, 2);
    Vector6d gradient;
    Matrix6d hessian;
    double score = computeDerivatives(gradient, hessian, moved, parameters);
    result_.reason = "stopped at the limit of iterations";
    while (result_.iterations < parameters_.max_iterations && !result_.converged) {
      const Eigen::Vector3d before = centroid();
      const Eigen::JacobiSVD<Matrix6d> svd(hessian, Eigen::ComputeFullU | Eigen::ComputeFullV);
      Vector6d step = svd.solve(-gradient);
      const double length = step.norm();
      if (!(length > 0.0) || !std::isfinite(length)) {
        result_.reason = "no cell of the target is near the source";
        return;
      }
      step /= length;
      const double taken = computeStepLengthMT(parameters, step, length, parameters_.max_step,
                                               parameters_.translation_epsilon / 2.0, score,
                                               gradient, hessian, moved);
      parameters += taken * step;
      ++result_.iterations;
      // A step that the line search cut short is short for that reason, not for being at the end.
      result_.converged =
          taken >= length && (centroid() - before).norm() < parameters_.translation_epsilon;
    }
    if (result_.converged) result_.reason.clear();
  }

 private:
  Transform pose() const {
    return Transform(Eigen::Matrix4d(final_transformation_.cast<double>()));
  }
  Eigen::Vector3d centroid() const { return pose() * source_centroid_; }

  // Derivatives of a moved point, by its new and by its old name in PCL.
  template <class Self>
  static auto pointJacobian(Self& self, int) -> decltype((self.point_jacobian_)) {
    return self.point_jacobian_;
  }
  template <class Self>
  static auto pointJacobian(Self& self, long) -> decltype((self.point_gradient_)) {
    return self.point_gradient_;
  }

  /// Equation 6.8 of Magnusson 2009.
  void prepareMixture() {
    const double c1 = 10.0 * (1.0 - outlier_ratio_);
    const double c2 = outlier_ratio_ / std::pow(resolution_, 3);
    const double d3 = -std::log(c2);
    gauss_d1_ = -std::log(c1 + c2) - d3;
    gauss_d2_ = -2.0 * std::log((-std::log(c1 * std::exp(-0.5) + c2) - d3) / gauss_d1_);
    Eigen::Matrix<double, 3, 6>& jacobian = pointJacobian(*this, 0);
    jacobian.setZero();
    jacobian.block<3, 3>(0, 0).setIdentity();
    point_hessian_.setZero();
  }

  const NdtParameters& parameters_;
  Eigen::Vector3d source_centroid_ = Eigen::Vector3d::Zero();
  RegistrationResult result_;
};

class Ndt : public Registration {
 public:
  explicit Ndt(ParameterReader& reader) : parameters_(reader) {}

 protected:
  void prepareTarget(const PointCloud& target) override {
    requirePoints(target.points, kMinNdtPoints, "target");
    from_coarse_to_fine_.clear();
    for (int level = parameters_.levels - 1; level >= 0; --level) {
      from_coarse_to_fine_.push_back(
          std::make_unique<PclNdt>(parameters_, parameters_.leafOf(level), target.points));
    }
  }

  RegistrationResult alignSource(const PointCloud& source, const Transform& guess) override {
    const Points points = parameters_.filter_source
                              ? voxelGrid(source.points, parameters_.leafOfSource())
                              : source.points;
    requirePoints(points, kMinNdtPoints, "source");
    RegistrationResult result;
    result.T_target_source = guess;
    for (const auto& ndt : from_coarse_to_fine_) {
      const int iterations = result.iterations;
      result = ndt->run(points, result.T_target_source);
      result.iterations += iterations;
    }
    return result;
  }

 private:
  NdtParameters parameters_;
  std::vector<std::unique_ptr<PclNdt>> from_coarse_to_fine_;
};

PCRB_REGISTER_METHOD("ndt", Ndt)

}  // namespace
}  // namespace pcrb
