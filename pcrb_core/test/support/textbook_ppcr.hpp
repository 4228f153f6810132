#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "pcrb_core/transform.hpp"

namespace pcrb_test {

/// PPCR written down from the formulas, with nothing done for speed: the oracle of the real one. In
/// double, every neighbour found by comparing all points, one term for every pair.
class TextbookPpcr {
 public:
  using Cloud = std::vector<Eigen::Vector3f>;

  TextbookPpcr(const Cloud& target, const Cloud& source, std::size_t neighbors)
      : target_(target), source_(source), neighbors_(neighbors) {}

  pcrb::Transform align(pcrb::Transform T) {
    int steady = 0;
    for (int outer = 0; outer < 200 && steady <= 20; ++outer) {
      associate(T);
      const double first = cost(T);
      double previous = first;
      for (int inner = 0; inner < 100; ++inner) {
        T = maximize();
        const double now = cost(T);
        const double change = std::abs(previous - now) / previous;
        previous = now;
        if (change < 1e-5) break;
      }
      steady = (first - previous) / first < 0.01 ? steady + 1 : 0;
    }
    return T;
  }

 private:
  struct Pair {
    std::size_t source;
    Eigen::Vector3d x, y;
    double s;  // m², at the association
    double w;  // of the E step
  };

  void associate(const pcrb::Transform& T) {
    pairs_.clear();
    for (std::size_t i = 0; i < source_.size(); ++i) {
      const Eigen::Vector3d x = source_[i].cast<double>();
      std::vector<Pair> all;
      for (const auto& point : target_) {
        const Eigen::Vector3d y = point.cast<double>();
        all.push_back({i, x, y, (y - T * x).squaredNorm(), 0.0});
      }
      const auto end = all.begin() + static_cast<std::ptrdiff_t>(std::min(neighbors_, all.size()));
      std::partial_sort(all.begin(), end, all.end(), closer);
      pairs_.insert(pairs_.end(), all.begin(), end);
    }
    std::vector<Pair> sorted = pairs_;
    std::sort(sorted.begin(), sorted.end(), closer);
    const double cut = sorted[static_cast<std::size_t>(0.7 * static_cast<double>(sorted.size()))].s;
    pairs_.erase(std::remove_if(pairs_.begin(), pairs_.end(),
                                [cut](const Pair& pair) { return pair.s > cut; }),
                 pairs_.end());
  }

  static bool closer(const Pair& a, const Pair& b) { return a.s < b.s; }

  /// E step at a pose; returns Σ w ρ(s), twice the M step's cost.
  double cost(const pcrb::Transform& T) {
    std::vector<double> total(source_.size(), 0.0);
    for (auto& pair : pairs_) {
      pair.s = (pair.y - T * pair.x).squaredNorm();
      pair.w = std::pow(1.0 + pair.s / 5.0, -(5.0 + 3.0) / 2.0);
      total[pair.source] += pair.w;
    }
    double sum = 0.0;
    for (auto& pair : pairs_) {
      pair.w *= (5.0 + 3.0) / (5.0 + pair.s) / total[pair.source];
      sum += pair.w * 2.0 * (std::sqrt(1.0 + pair.s) - 1.0);
    }
    return sum;
  }

  /// M step with the weights of the last E step: weighted Procrustes over all pairs.
  pcrb::Transform maximize() const {
    double weight = 0.0;
    Eigen::Vector3d mean_x = Eigen::Vector3d::Zero(), mean_y = Eigen::Vector3d::Zero();
    for (const auto& pair : pairs_) {
      const double w = pair.w / std::sqrt(1.0 + pair.s);
      weight += w;
      mean_x += w * pair.x;
      mean_y += w * pair.y;
    }
    mean_x /= weight;
    mean_y /= weight;
    Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
    for (const auto& pair : pairs_) {
      const double w = pair.w / std::sqrt(1.0 + pair.s);
      H += w * (pair.y - mean_y) * (pair.x - mean_x).transpose();
    }
    pcrb::Transform T = pcrb::Transform::Identity();
    T.linear() = pcrb::nearestRotation(H);
    T.translation() = mean_y - T.linear() * mean_x;
    return T;
  }

  const Cloud& target_;
  const Cloud& source_;
  std::size_t neighbors_;
  std::vector<Pair> pairs_;
};

}  // namespace pcrb_test
