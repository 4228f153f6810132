#include <algorithm>
#include <cmath>

#include "pcrb_core/parallel.hpp"
#include "pcrb_core/registration/preprocessing.hpp"
#include "registration/features.hpp"

namespace pcrb {
namespace {

constexpr float kPi = 3.14159265358979F;
constexpr float kSum = 100.0F;

/// atan2 to 1e-4 rad: the library's differs in its last bits between processors.
float angleOf(float y, float x) {
  const float ax = std::abs(x);
  const float ay = std::abs(y);
  const float big = std::max(ax, ay);
  if (big == 0.0F) return 0.0F;
  const float t = std::min(ax, ay) / big;
  const float s = t * t;
  float angle = ((-0.0464964749F * s + 0.15931422F) * s - 0.327622764F) * s * t + t;
  if (ay > ax) angle = kPi / 2.0F - angle;
  if (x < 0.0F) angle = kPi - angle;
  return y < 0.0F ? -angle : angle;
}

std::size_t binOf(float value, float low, float high) {
  const float scaled = (value - low) / (high - low) * static_cast<float>(kFpfhBins);
  return static_cast<std::size_t>(
      std::clamp(static_cast<int>(std::floor(scaled)), 0, static_cast<int>(kFpfhBins) - 1));
}

struct Bins {
  std::size_t f1, f2, f3;
};

/// The three angles between two oriented points, in the Darboux frame at the one whose normal is
/// nearer to their connection. False where they do not have one.
bool pairBins(const Eigen::Vector3f& p, const Eigen::Vector3f& np, const Eigen::Vector3f& q,
              const Eigen::Vector3f& nq, Bins& bins) {
  const Eigen::Vector3f offset = q - p;
  const float distance = offset.norm();
  if (distance == 0.0F) return false;
  const float angle_p = np.dot(offset) / distance;
  const float angle_q = nq.dot(offset) / distance;
  const bool swapped = std::abs(angle_p) < std::abs(angle_q);
  const Eigen::Vector3f& u = swapped ? nq : np;
  const Eigen::Vector3f& n = swapped ? np : nq;
  Eigen::Vector3f v = offset.cross(u);
  if (swapped) v = -v;
  const float length = v.norm();
  if (length == 0.0F) return false;
  v /= length;
  const Eigen::Vector3f w = u.cross(v);
  bins.f1 = binOf(angleOf(w.dot(n), u.dot(n)), -kPi, kPi);
  bins.f2 = kFpfhBins + binOf(v.dot(n), -1.0F, 1.0F);
  bins.f3 = 2 * kFpfhBins + binOf(swapped ? -angle_q : angle_p, -1.0F, 1.0F);
  return true;
}

class Estimator {
 public:
  Estimator(const KdTree& tree, const Points& normals, float radius, int threads)
      : points_(tree.points()),
        normals_(normals),
        radius_(radius),
        threads_(threads),
        tree_(tree),
        neighbors_(points_.size()),
        simplified_(points_.size(), Fpfh{}) {
    forEachPoint([this](std::size_t i, std::vector<Neighbor>& found) {
      findNeighbors(i, found);
      simplify(i);
    });
  }

  FpfhCloud estimate() const {
    std::vector<Fpfh> all(points_.size(), Fpfh{});
    std::vector<std::uint8_t> defined(points_.size(), 0);
    forEachPoint([&](std::size_t i, std::vector<Neighbor>&) { defined[i] = weigh(i, all[i]); });
    FpfhCloud cloud;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (defined[i] == 0) continue;
      cloud.points.push_back(points_[i]);
      cloud.features.push_back(all[i]);
    }
    return cloud;
  }

 private:
  template <class Body>
  void forEachPoint(const Body& body) const {
    forBlocks(points_.size(), threads_, [&](std::size_t begin, std::size_t end) {
      std::vector<Neighbor> scratch;
      for (std::size_t i = begin; i < end; ++i) body(i, scratch);
    });
  }

  bool hasNormal(std::size_t i) const { return !normals_[i].isZero(0.0F); }

  void findNeighbors(std::size_t i, std::vector<Neighbor>& found) {
    if (!hasNormal(i)) return;
    tree_.within(points_[i], radius_, found);
    for (const auto& neighbor : found) {
      if (neighbor.index != i && hasNormal(neighbor.index)) {
        neighbors_[i].push_back(neighbor.index);
      }
    }
  }

  /// SPFH: histograms of the angles between a point and each of its neighbours.
  void simplify(std::size_t i) {
    std::array<std::uint32_t, kFpfhSize> counts{};
    for (const std::uint32_t j : neighbors_[i]) {
      Bins bins{};
      if (!pairBins(points_[i], normals_[i], points_[j], normals_[j], bins)) continue;
      ++counts[bins.f1];
      ++counts[bins.f2];
      ++counts[bins.f3];
    }
    if (neighbors_[i].empty()) return;
    const float increment = kSum / static_cast<float>(neighbors_[i].size());
    for (std::size_t bin = 0; bin < kFpfhSize; ++bin) {
      simplified_[i][bin] = increment * static_cast<float>(counts[bin]);
    }
  }

  /// FPFH: the neighbours' SPFHs by the inverse of their squared distance, normalised.
  bool weigh(std::size_t i, Fpfh& feature) const {
    for (const std::uint32_t j : neighbors_[i]) {
      const float squared_distance = (points_[j] - points_[i]).squaredNorm();
      if (squared_distance == 0.0F) continue;
      const float weight = 1.0F / squared_distance;
      for (std::size_t bin = 0; bin < kFpfhSize; ++bin)
        feature[bin] += weight * simplified_[j][bin];
    }
    for (std::size_t part = 0; part < kFpfhSize; part += kFpfhBins) {
      float sum = 0.0F;
      for (std::size_t bin = part; bin < part + kFpfhBins; ++bin) sum += feature[bin];
      if (!(sum > 0.0F)) return false;
      for (std::size_t bin = part; bin < part + kFpfhBins; ++bin) feature[bin] *= kSum / sum;
    }
    return true;
  }

  const Points& points_;
  const Points& normals_;
  float radius_;
  int threads_;
  const KdTree& tree_;
  std::vector<std::vector<std::uint32_t>> neighbors_;  // with a normal, without the point itself
  std::vector<Fpfh> simplified_;
};

}  // namespace

FpfhCloud computeFpfh(const KdTree& tree, double normal_radius, double feature_radius,
                      int threads) {
  Points normals = surfaceNormalsWithin(tree, normal_radius, threads);
  const Eigen::Vector3f center = meanOf(tree.points()).cast<float>();
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (normals[i].dot(center - tree.points()[i]) < 0.0F) normals[i] = -normals[i];
  }
  return Estimator(tree, normals, static_cast<float>(feature_radius), threads).estimate();
}

}  // namespace pcrb
