#include <array>
#include <cmath>

#include "arithmetic.hpp"
#include "pcrb_core/parallel.hpp"
#include "pcrb_core/registration/registration.hpp"
#include "registration/ppcr_steps.hpp"

namespace pcrb {
namespace {

using Lanes = std::array<float, kSourceLanes>;

/// Weights and weighted residuals of kSourceLanes source points.
struct LaneSums {
  Lanes weight{}, x{}, y{}, z{}, cost{};
};

/// Steps E and M's weights for kSourceLanes source points at (mx, my, mz). The same bits on every
/// processor: lanes are never added to each other here.
PCRB_CLONES_AVX2 void weighPairs(const PpcrAssociation::Pairs& pairs, std::size_t first,
                                 std::size_t neighbors, bool robust, const Lanes& mx,
                                 const Lanes& my, const Lanes& mz, LaneSums& sums) {
  constexpr float kFreedom = 5.0F;     // ν
  constexpr float kDimensions = 3.0F;  // d
  Lanes total{};
  for (std::size_t k = 0; k < neighbors; ++k) {
    const std::size_t entry = first + k * kSourceLanes;
    for (std::size_t lane = 0; lane < kSourceLanes; ++lane) {
      const float dx = pairs.x[entry + lane] - mx[lane];
      const float dy = pairs.y[entry + lane] - my[lane];
      const float dz = pairs.z[entry + lane] - mz[lane];
      const float s = dx * dx + dy * dy + dz * dz;
      const float u = 1.0F / (kFreedom + s);
      const float root = robust ? std::sqrt(1.0F + s) : 1.0F;
      // p ∝ (1 + s/ν)^−(ν+d)/2, the exponent being −4; w = r (ν+d)/(ν+s), with r = p/Σp below.
      const float p = pairs.kept[entry + lane] * (u * u) * (u * u);
      const float w = p * u * (kFreedom + kDimensions);
      const float irls = w / root;
      total[lane] += p;
      sums.weight[lane] += irls;
      sums.x[lane] += irls * dx;
      sums.y[lane] += irls * dy;
      sums.z[lane] += irls * dz;
      sums.cost[lane] += robust ? w * 2.0F * (root - 1.0F) : w * s;
    }
  }
  for (std::size_t lane = 0; lane < kSourceLanes; ++lane) {
    const float normalize = total[lane] > 0.0F ? 1.0F / total[lane] : 0.0F;
    sums.weight[lane] *= normalize;
    sums.x[lane] *= normalize;
    sums.y[lane] *= normalize;
    sums.z[lane] *= normalize;
    sums.cost[lane] *= normalize;
  }
}

}  // namespace

/// Sums over source points x with weight W and weighted mean partner ȳ.
struct PpcrSolver::Moments {
  double weight = 0.0;
  double cost = 0.0;
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  Eigen::Vector3d y = Eigen::Vector3d::Zero();
  Eigen::Matrix3d yx = Eigen::Matrix3d::Zero();

  void operator+=(const Moments& other) {
    weight += other.weight;
    cost += other.cost;
    x += other.x;
    y += other.y;
    yx += other.yx;
  }

  void add(const LaneSums& sums, std::size_t lane, const Eigen::Vector3d& point,
           const Eigen::Vector3d& moved) {
    const double W = sums.weight[lane];
    const Eigen::Vector3d partner =
        W * moved + Eigen::Vector3d(sums.x[lane], sums.y[lane], sums.z[lane]);
    weight += W;
    cost += sums.cost[lane];
    x += W * point;
    y += partner;
    yx += partner * point.transpose();
  }

  /// The M step: weighted orthogonal Procrustes.
  Transform solve() const {
    const Eigen::Vector3d mean_x = x / weight;
    Transform T = Transform::Identity();
    T.linear() = nearestRotation(yx - y * mean_x.transpose());
    T.translation() = y / weight - T.linear() * mean_x;
    return T;
  }
};

PpcrSolver::PpcrSolver(const Points& source, bool robust, int threads)
    : robust_(robust), threads_(threads) {
  for (const auto& point : source) source_.push_back(point.cast<double>());
}

PpcrSolver::Moments PpcrSolver::expectation(const PpcrAssociation& association,
                                            const Transform& T) const {
  static_assert(kBlockSize % kSourceLanes == 0);
  std::vector<Moments> parts((source_.size() + kBlockSize - 1) / kBlockSize);
  forBlocks(source_.size(), threads_, [&](std::size_t begin, std::size_t end) {
    Moments& part = parts[begin / kBlockSize];
    for (std::size_t i = begin; i < end; i += kSourceLanes) {
      const std::size_t count = std::min(kSourceLanes, end - i);
      std::array<Eigen::Vector3d, kSourceLanes> moved;
      Lanes mx{}, my{}, mz{};
      for (std::size_t lane = 0; lane < count; ++lane) {
        moved[lane] = T * source_[i + lane];
        mx[lane] = static_cast<float>(moved[lane].x());
        my[lane] = static_cast<float>(moved[lane].y());
        mz[lane] = static_cast<float>(moved[lane].z());
      }
      LaneSums sums;
      weighPairs(association.pairs(), i * association.neighbors(), association.neighbors(), robust_,
                 mx, my, mz, sums);
      for (std::size_t lane = 0; lane < count; ++lane) {
        part.add(sums, lane, source_[i + lane], moved[lane]);
      }
    }
  });
  Moments all;
  for (const auto& part : parts) all += part;
  return all;
}

PpcrSolver::Solution PpcrSolver::solve(const PpcrAssociation& association, const Transform& start,
                                       double tolerance, int max_iterations) const {
  Solution solution;
  solution.T_target_source = start;
  Moments moments = expectation(association, start);
  if (!(moments.weight > 0.0)) throw RegistrationFailed("found no pair of points close enough");
  solution.first_cost = solution.cost = moments.cost;
  double change = std::numeric_limits<double>::infinity();
  while (solution.iterations < max_iterations && change >= tolerance) {
    solution.T_target_source = moments.solve();
    moments = expectation(association, solution.T_target_source);
    change = std::abs(solution.cost - moments.cost) /
             std::max(solution.cost, std::numeric_limits<double>::min());
    solution.cost = moments.cost;
    ++solution.iterations;
  }
  return solution;
}

}  // namespace pcrb
