#include <utility>

#include "pcrb_core/parallel.hpp"
#include "registration/features.hpp"
#include "search/nanoflann.hpp"

namespace pcrb {
namespace {

constexpr std::size_t kMinMatches = 3;
constexpr std::uint32_t kNone = 0xffffffffU;

}  // namespace

FeatureParameters::FeatureParameters(ParameterReader& reader)
    : voxel_leaf(reader.positive("voxel_leaf", 0.2)),
      normal_radius_leaves(reader.number("normal_radius_leaves", 2.0, 1.0, 100.0)),
      feature_radius_leaves(reader.number("feature_radius_leaves", 5.0, 1.0, 100.0)),
      threads(reader.threads()) {}

/// A cloud's features and a search tree of them, nearest by squared Euclidean distance.
class FeatureMatcher::Index {
 public:
  explicit Index(FpfhCloud described)
      : cloud(std::move(described)),
        set_{cloud.features},
        tree_(kFpfhSize, set_, nanoflann::KDTreeSingleIndexAdaptorParams(kLeafSize)) {
    buildNanoflann(tree_);
  }

  /// For the chosen ones of some features the index of their nearest here.
  std::vector<std::uint32_t> nearestOf(const std::vector<Fpfh>& features,
                                       const std::vector<std::uint8_t>& chosen, int threads) const {
    std::vector<std::uint32_t> found(features.size(), kNone);
    forBlocks(features.size(), threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (chosen[i] != 0) found[i] = nearest(features[i]);
      }
    });
    return found;
  }

  const FpfhCloud cloud;

 private:
  static constexpr std::size_t kLeafSize = 20;

  /// nanoflann's view of features.
  struct FeatureSet {
    const std::vector<Fpfh>& values;

    std::size_t kdtree_get_point_count() const { return values.size(); }
    float kdtree_get_pt(std::size_t index, std::size_t bin) const { return values[index][bin]; }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
      return false;
    }
  };

  std::uint32_t nearest(const Fpfh& query) const {
    std::uint32_t index = 0;
    float squared_distance = 0.0F;
    nanoflann::KNNResultSet<float, std::uint32_t> result(1);
    result.init(&index, &squared_distance);
    tree_.findNeighbors(result, query.data(), NanoflannParameters());
    return index;
  }

  FeatureSet set_;
  nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Adaptor<float, FeatureSet, float>, FeatureSet,
                                      kFpfhSize, std::uint32_t>
      tree_;
};

FeatureMatcher::FeatureMatcher(const FeatureParameters& parameters) : parameters_(parameters) {}
FeatureMatcher::~FeatureMatcher() = default;
FeatureMatcher::FeatureMatcher(FeatureMatcher&&) noexcept = default;
FeatureMatcher& FeatureMatcher::operator=(FeatureMatcher&&) noexcept = default;

FpfhCloud FeatureMatcher::describe(const Points& points, const char* what) const {
  const double leaf = parameters_.voxel_leaf;
  FpfhCloud cloud =
      computeFpfh(KdTree(voxelGrid(points, leaf)), parameters_.normal_radius_leaves * leaf,
                  parameters_.feature_radius_leaves * leaf, parameters_.threads);
  if (cloud.points.size() < kMinMatches) {
    throw InvalidProblem(std::string(what) + ": found " + std::to_string(cloud.points.size()) +
                         " points with a feature, expected at least 3");
  }
  return cloud;
}

void FeatureMatcher::setTarget(const Points& target) {
  target_ = std::make_unique<Index>(describe(target, "target"));
}

Matches FeatureMatcher::match(const Points& source) const {
  const Index described(describe(source, "source"));
  const auto& source_features = described.cloud.features;
  const auto& target_features = target_->cloud.features;
  const std::vector<std::uint8_t> all(source_features.size(), 1);
  const auto forth = target_->nearestOf(source_features, all, parameters_.threads);
  std::vector<std::uint8_t> chosen(target_features.size(), 0);
  for (const std::uint32_t j : forth) chosen[j] = 1;
  const auto back = described.nearestOf(target_features, chosen, parameters_.threads);

  Matches matches;
  for (std::uint32_t i = 0; i < forth.size(); ++i) {
    if (back[forth[i]] != i) continue;
    matches.source.push_back(described.cloud.points[i]);
    matches.target.push_back(target_->cloud.points[forth[i]]);
  }
  if (matches.size() < kMinMatches) {
    throw RegistrationFailed("found " + std::to_string(matches.size()) +
                             " matches of features, expected at least 3");
  }
  return matches;
}

Transform fitRigid(const Matches& matches, const std::vector<double>& weights) {
  double total = 0.0;
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  Eigen::Vector3d y = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < matches.size(); ++i) {
    total += weights[i];
    x += weights[i] * matches.source[i].cast<double>();
    y += weights[i] * matches.target[i].cast<double>();
  }
  if (!(total > 0.0)) return Transform::Identity();
  x /= total;
  y /= total;
  Eigen::Matrix3d correlation = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < matches.size(); ++i) {
    correlation += weights[i] * (matches.target[i].cast<double>() - y) *
                   (matches.source[i].cast<double>() - x).transpose();
  }
  Transform T = Transform::Identity();
  T.linear() = nearestRotation(correlation);
  T.translation() = y - T.linear() * x;
  return T;
}

}  // namespace pcrb
