// G-ICP as the paper runs it, on PCL's GeneralizedIterativeClosestPoint. PCL's cost function and
// BFGS optimiser are used as they are. PCL's outer loop ignores rejectors and tests matrix elements
// for convergence, so the loop is ours: nearest neighbours, PCL's median rejector, PCL's optimiser,
// movement of the source's centroid.

#include <pcl/registration/correspondence_rejection_median_distance.h>
#include <pcl/registration/gicp.h>

#include <numeric>
#include <optional>

#include "pcrb_core/parallel.hpp"
#include "pcrb_core/registration/preprocessing.hpp"
#include "pcrb_core/registration/registry.hpp"
#include "registration/pcl_common.hpp"

namespace pcrb {
namespace {

using Point = pcl::PointXYZ;
#if PCL_VERSION_COMPARE(>=, 1, 13, 0)
using PclGicp = pcl::GeneralizedIterativeClosestPoint<Point, Point, double>;
#else
using PclGicp = pcl::GeneralizedIterativeClosestPoint<Point, Point>;
#endif
using Covariances = std::vector<Eigen::Matrix3d>;

struct GicpParameters : IcpParameters {
  explicit GicpParameters(ParameterReader& reader)
      : IcpParameters(reader),
        neighbors(reader.integer("covariance_neighbors", 20, 4, 1000)),
        covariance_epsilon(reader.number("covariance_epsilon", 0.001, 1e-9, 1.0)),
        inner_iterations(reader.integer("inner_iterations", 20, 1)) {}

  int neighbors;              ///< points whose covariance is a point's
  double covariance_epsilon;  ///< along the normal, where it is 1 in the plane
  int inner_iterations;       ///< of the optimiser at most, with fixed correspondences
};

/// Covariances of flat discs (1, 1, epsilon) on the surface of a cloud. Source: Segal, Haehnel,
/// Thrun, Generalized-ICP, RSS 2009, section III.B.
Covariances discCovariances(const KdTree& tree, const GicpParameters& parameters) {
  const Points normals =
      surfaceNormals(tree, static_cast<std::size_t>(parameters.neighbors), parameters.threads);
  Covariances covariances;
  covariances.reserve(normals.size());
  for (const auto& normal : normals) {
    const Eigen::Vector3d n = normal.cast<double>();
    covariances.emplace_back(Eigen::Matrix3d::Identity() -
                             (1.0 - parameters.covariance_epsilon) * n * n.transpose());
  }
  return covariances;
}

/// One target or source: points, tree and covariances.
struct Surface {
  Surface(Points points, const GicpParameters& parameters)
      : tree(std::move(points)), covariances(discCovariances(tree, parameters)) {}

  KdTree tree;
  Covariances covariances;
};

Eigen::Matrix3d skewMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return matrix;
}

/// PCL's optimiser for one set of correspondences.
class Optimizer : public PclGicp {
 public:
  explicit Optimizer(int inner_iterations) {
    setMaximumOptimizerIterations(inner_iterations);
    base_transformation_.setIdentity();
  }

  /// Improves T for paired points; `information` has the inverse covariance of each pair.
  void optimize(const PclCloud& source, const PclCloud& target, const Covariances& information,
                Eigen::Matrix4d& T) {
    mahalanobis_.assign(information.begin(), information.end());
    std::vector<int> indices(source.size());
    std::iota(indices.begin(), indices.end(), 0);
    PclMatrix4 improved = T.cast<PclScalar>();
    estimateRigidTransformationBFGS(source, indices, target, indices, improved);
    T = improved.cast<double>();
  }
};

/// One alignment. It works relative to the source's centroid after the initial guess: there the
/// optimiser is well conditioned, and the translation is the centroid's movement.
class Alignment {
 public:
  Alignment(const Surface& target, const Surface& source, const Transform& guess,
            const GicpParameters& parameters)
      : target_(target), source_(source), guess_(guess), parameters_(parameters) {
    center_ = guess * meanOf(source.tree.points());
    for (const auto& point : source.tree.points()) {
      const Eigen::Vector3d moved = guess * point.cast<double>() - center_;
      moved_.push_back(toPoint(moved));
    }
    rejector_.setMedianFactor(parameters.rejection_factor * parameters.rejection_factor);
  }

  RegistrationResult run() {
    RegistrationResult result;
    Optimizer optimizer(parameters_.inner_iterations);
    Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
    double movement = std::numeric_limits<double>::infinity();
    while (result.iterations < parameters_.max_iterations &&
           movement >= parameters_.translation_epsilon) {
      const Eigen::Matrix4d previous = T;
      if (!improve(optimizer, T, result.reason)) break;
      movement = (T - previous).topRightCorner<3, 1>().norm();
      ++result.iterations;
    }
    result.converged = movement < parameters_.translation_epsilon;
    if (!result.converged && result.reason.empty()) {
      result.reason = "stopped at the limit of iterations";
    }
    result.T_target_source =
        Eigen::Translation3d(center_) * Transform(T) * Eigen::Translation3d(-center_) * guess_;
    result.T_target_source.linear() = nearestRotation(result.T_target_source.linear());
    result.covariance = covarianceOf(T);
    return result;
  }

 private:
  static Point toPoint(const Eigen::Vector3d& p) {
    return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
  }

  /// One iteration; false, with the reason, if PCL's optimiser gives up.
  bool improve(Optimizer& optimizer, Eigen::Matrix4d& T, std::string& reason) {
    const pcl::Correspondences pairs = associate(T);
    PclCloud source;
    PclCloud target;
    for (const auto& pair : pairs) {
      source.push_back(moved_[static_cast<std::size_t>(pair.index_query)]);
      const auto& q = target_.tree.points()[static_cast<std::size_t>(pair.index_match)];
      target.push_back(toPoint(q.cast<double>() - center_));
    }
    try {
      optimizer.optimize(source, target, informationOf(pairs, T), T);
      return true;
    } catch (const pcl::PCLException& error) {
      reason = std::string("PCL's optimiser: ") + error.what();
      return false;
    }
  }

  pcl::Correspondences associate(const Eigen::Matrix4d& T) {
    const Transform T_target_moved = Eigen::Translation3d(center_) * Transform(T);
    PclCloud queries;
    queries.reserve(moved_.size());
    for (const auto& point : moved_) {
      queries.push_back(toPoint(T_target_moved * point.getVector3fMap().cast<double>()));
    }
    pcl::Correspondences all;
    nearestCorrespondences(target_.tree, queries, parameters_.threads, all);
    pcl::Correspondences kept;
    rejector_.getRemainingCorrespondences(all, kept);
    return kept;
  }

  /// Of the pose, from the curvature of the cost at its minimum and the size of what is left of it,
  /// as of independent errors of the pairs: they are not, so that it is too small.
  std::optional<PoseCovariance> covarianceOf(const Eigen::Matrix4d& T) {
    using Matrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
    const pcl::Correspondences pairs = associate(T);
    if (pairs.size() < 4) return std::nullopt;
    const Covariances information = informationOf(pairs, T);
    const Transform moved_by(T);
    Matrix6 curvature = Matrix6::Zero();
    double cost = 0.0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto& p = moved_[static_cast<std::size_t>(pairs[i].index_query)];
      const auto& q = target_.tree.points()[static_cast<std::size_t>(pairs[i].index_match)];
      const Eigen::Vector3d arm = moved_by.linear() * p.getVector3fMap().cast<double>();
      const Eigen::Vector3d left = q.cast<double>() - center_ - arm - moved_by.translation();
      Eigen::Matrix<double, 3, 6> J;  // d(T p) = dt + dθ × arm
      J << Eigen::Matrix3d::Identity(), skewMatrix(-arm);
      curvature += J.transpose() * information[i] * J;
      cost += left.dot(information[i] * left);
    }
    const Eigen::LDLT<Matrix6> inverse(curvature);
    if (!inverse.isPositive() || inverse.rcond() < 1e-15) return std::nullopt;
    const double variance = cost / (3.0 * static_cast<double>(pairs.size()) - 6.0);
    PoseCovariance covariance{};
    const Matrix6 C = variance * inverse.solve(Matrix6::Identity().eval());
    Eigen::Map<Matrix6>(covariance.data()) = (C + C.transpose()) / 2.0;
    return mountedCovariance(covariance, moved_by, Eigen::Translation3d(-center_) * guess_);
  }

  Covariances informationOf(const pcl::Correspondences& pairs, const Eigen::Matrix4d& T) const {
    const Eigen::Matrix3d R = T.topLeftCorner<3, 3>() * guess_.linear();
    Covariances information(pairs.size());
    forBlocks(pairs.size(), parameters_.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto& C_source = source_.covariances[static_cast<std::size_t>(pairs[i].index_query)];
        const auto& C_target = target_.covariances[static_cast<std::size_t>(pairs[i].index_match)];
        information[i] = (C_target + R * C_source * R.transpose()).inverse();
      }
    });
    return information;
  }

  const Surface& target_;
  const Surface& source_;
  Transform guess_;
  const GicpParameters& parameters_;
  Eigen::Vector3d center_;  // m, in the target's frame
  PclCloud moved_;          // source after the guess, relative to center_
  pcl::registration::CorrespondenceRejectorMedianDistance rejector_;
};

class GicpMethod : public Registration {
 public:
  explicit GicpMethod(ParameterReader& reader) : parameters_(reader) {}

 protected:
  void prepareTarget(const PointCloud& target) override {
    target_.emplace(filtered(parameters_.filterTarget(target.points), "target"), parameters_);
  }

  RegistrationResult alignSource(const PointCloud& source, const Transform& guess) override {
    const Surface surface(filtered(parameters_.filterSource(source.points), "source"), parameters_);
    return Alignment(*target_, surface, guess, parameters_).run();
  }

 private:
  Points filtered(Points points, const char* what) const {
    requirePoints(points, static_cast<std::size_t>(parameters_.neighbors), what);
    return points;
  }

  GicpParameters parameters_;
  std::optional<Surface> target_;
};

PCRB_REGISTER_METHOD("gicp", GicpMethod)

}  // namespace
}  // namespace pcrb
