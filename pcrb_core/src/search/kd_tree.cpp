#include "pcrb_core/search/kd_tree.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "pcrb_core/error.hpp"
#include "search/nanoflann.hpp"

namespace pcrb {
namespace {

constexpr std::size_t kLeafSize = 10;

/// Collects the nearest points, nearest first, directly as Neighbors.
class NearestSet {
 public:
  using DistanceType = float;
  using IndexType = std::uint32_t;

  NearestSet(Neighbor* neighbors, std::size_t capacity)
      : neighbors_(neighbors), capacity_(capacity) {}

  std::size_t size() const { return size_; }
  bool full() const { return size_ == capacity_; }
  float worstDist() const {
    return full() ? neighbors_[capacity_ - 1].squared_distance : std::numeric_limits<float>::max();
  }
  bool addPoint(float squared_distance, std::uint32_t index) {
    // nanoflann compares with the worst distance at the leaf's start, which may be an old one.
    if (squared_distance >= worstDist()) return true;
    std::size_t place = full() ? capacity_ - 1 : size_++;
    for (; place > 0 && neighbors_[place - 1].squared_distance > squared_distance; --place) {
      neighbors_[place] = neighbors_[place - 1];
    }
    neighbors_[place] = {index, squared_distance};
    return true;
  }
  void sort() {}  // nanoflann asks for it since 1.5; they are in order

 private:
  Neighbor* neighbors_;
  std::size_t capacity_;
  std::size_t size_ = 0;
};

/// Collects all points closer than a radius.
class WithinSet {
 public:
  using DistanceType = float;
  using IndexType = std::uint32_t;

  WithinSet(float squared_radius, std::vector<Neighbor>& neighbors)
      : squared_radius_(squared_radius), neighbors_(neighbors) {}

  std::size_t size() const { return neighbors_.size(); }
  bool full() const { return true; }
  float worstDist() const { return squared_radius_; }
  bool addPoint(float squared_distance, std::uint32_t index) {
    if (squared_distance < squared_radius_) neighbors_.push_back({index, squared_distance});
    return true;
  }
  void sort() {}  // in no order

 private:
  float squared_radius_;
  std::vector<Neighbor>& neighbors_;
};

}  // namespace

struct KdTree::Index {
  /// nanoflann's view of the points.
  struct Points {
    std::vector<Eigen::Vector3f> values;

    std::size_t kdtree_get_point_count() const { return values.size(); }
    float kdtree_get_pt(std::size_t index, std::size_t axis) const {
      return values[index][static_cast<Eigen::Index>(axis)];
    }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
      return false;
    }
  };

  using Tree =
      nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Points, float>,
                                          Points, 3, std::uint32_t>;

  explicit Index(std::vector<Eigen::Vector3f> values)
      : points{std::move(values)},
        tree(3, points, nanoflann::KDTreeSingleIndexAdaptorParams(kLeafSize)) {
    buildNanoflann(tree);
  }

  Points points;
  Tree tree;
};

KdTree::KdTree(std::vector<Eigen::Vector3f> points) {
  if (points.empty()) throw InvalidProblem("found no points to search in, expected at least one");
  index_ = std::make_unique<Index>(std::move(points));
}

KdTree::~KdTree() = default;
KdTree::KdTree(KdTree&&) noexcept = default;
KdTree& KdTree::operator=(KdTree&&) noexcept = default;

const std::vector<Eigen::Vector3f>& KdTree::points() const { return index_->points.values; }

Neighbor KdTree::nearest(const Eigen::Vector3f& query) const {
  Neighbor neighbor;
  NearestSet result(&neighbor, 1);
  index_->tree.findNeighbors(result, query.data(), NanoflannParameters());
  return neighbor;
}

void KdTree::nearest(const Eigen::Vector3f& query, std::size_t count,
                     std::vector<Neighbor>& neighbors) const {
  neighbors.resize(std::min(count, points().size()));
  if (neighbors.empty()) return;
  NearestSet result(neighbors.data(), neighbors.size());
  index_->tree.findNeighbors(result, query.data(), NanoflannParameters());
}

void KdTree::within(const Eigen::Vector3f& query, float radius,
                    std::vector<Neighbor>& neighbors) const {
  neighbors.clear();
  WithinSet result(radius * radius, neighbors);
  index_->tree.findNeighbors(result, query.data(), NanoflannParameters());
}

}  // namespace pcrb
