#include <algorithm>
#include <cmath>
#include <limits>

#include "pcrb_core/parallel.hpp"
#include "pcrb_core/transform.hpp"
#include "registration/teaser_steps.hpp"

namespace pcrb {
namespace {

constexpr double kAnnealingFactor = 1.4;
constexpr double kCostTolerance = 1e-6;  // relative change of the cost that ends the iterations

/// Weights of GNC-TLS at one scale μ.
struct TruncatedWeights {
  double squared_bound;
  double scale;

  double operator()(double squared_residual) const {
    if (squared_residual >= squared_bound * (scale + 1.0) / scale) return 0.0;
    if (squared_residual <= squared_bound * scale / (scale + 1.0)) return 1.0;
    return std::sqrt(squared_bound * scale * (scale + 1.0) / squared_residual) - scale;
  }
};

/// Sums over all pairs of points, row by row so that they do not depend on the thread count.
class PairSums {
 public:
  PairSums(const Points& source, const Points& target, int threads) : threads_(threads) {
    for (std::size_t i = 0; i < source.size(); ++i) {
      a_.push_back(source[i].cast<double>());
      b_.push_back(target[i].cast<double>());
    }
  }

  struct Sums {
    Eigen::Matrix3d correlation = Eigen::Matrix3d::Zero();  // Σ w b aᵀ
    double weighted_squares = 0.0;                          // Σ w r²
    double largest = 0.0;                                   // max r²

    void operator+=(const Sums& other) {
      correlation += other.correlation;
      weighted_squares += other.weighted_squares;
      largest = std::max(largest, other.largest);
    }
  };

  template <class Weight>
  Sums sum(const Eigen::Matrix3d& R, const Weight& weight) const {
    std::vector<Sums> rows(a_.size());
    forBlocks(a_.size(), threads_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) rows[i] = sumRow(i, R, weight);
    });
    Sums all;
    for (const auto& row : rows) all += row;
    return all;
  }

 private:
  template <class Weight>
  Sums sumRow(std::size_t i, const Eigen::Matrix3d& R, const Weight& weight) const {
    Sums row;
    for (std::size_t j = i + 1; j < a_.size(); ++j) {
      const Eigen::Vector3d a = a_[j] - a_[i];
      const Eigen::Vector3d b = b_[j] - b_[i];
      const double squared_residual = (b - R * a).squaredNorm();
      const double w = weight(squared_residual);
      row.largest = std::max(row.largest, squared_residual);
      row.weighted_squares += w * squared_residual;
      row.correlation += w * b * a.transpose();
    }
    return row;
  }

  std::vector<Eigen::Vector3d> a_;
  std::vector<Eigen::Vector3d> b_;
  int threads_;
};

}  // namespace

RobustRotation estimateRotation(const Points& source, const Points& target, double bound,
                                int max_iterations, int threads) {
  const PairSums pairs(source, target, threads);
  const double squared_bound = bound * bound;
  const auto all = [](double) { return 1.0; };
  RobustRotation result;
  result.R = nearestRotation(pairs.sum(result.R, all).correlation);
  const double largest = pairs.sum(result.R, all).largest;
  if (2.0 * largest <= squared_bound) return result;

  TruncatedWeights weights{squared_bound, 1.0 / (2.0 * largest / squared_bound - 1.0)};
  double cost = std::numeric_limits<double>::infinity();
  while (result.iterations < max_iterations) {
    const auto sums = pairs.sum(result.R, weights);
    result.R = nearestRotation(sums.correlation);
    ++result.iterations;
    if (std::abs(cost - sums.weighted_squares) <= kCostTolerance * sums.weighted_squares) break;
    cost = sums.weighted_squares;
    weights.scale *= kAnnealingFactor;
  }
  return result;
}

double estimateNumber(const std::vector<double>& values, double bound) {
  struct End {
    double at;
    double value;
    bool is_start;
  };
  std::vector<End> ends;
  for (const double value : values) {
    ends.push_back({value - bound, value, true});
    ends.push_back({value + bound, value, false});
  }
  // At equal places intervals start before others end: they share that place.
  std::stable_sort(ends.begin(), ends.end(), [](const End& a, const End& b) {
    return a.at < b.at || (a.at == b.at && a.is_start && !b.is_start);
  });
  // Sums relative to a value near all of them keep the squares small.
  const double reference = values.front();
  double count = 0.0, sum = 0.0, squares = 0.0;
  double best_cost = std::numeric_limits<double>::infinity(), best = reference;
  for (const End& end : ends) {
    const double sign = end.is_start ? 1.0 : -1.0;
    const double offset = end.value - reference;
    count += sign;
    sum += sign * offset;
    squares += sign * offset * offset;
    if (count < 0.5) continue;
    const double outside = static_cast<double>(values.size()) - count;
    const double cost = squares - sum * sum / count + outside * bound * bound;
    if (cost < best_cost) {
      best_cost = cost;
      best = reference + sum / count;
    }
  }
  return best;
}

}  // namespace pcrb
