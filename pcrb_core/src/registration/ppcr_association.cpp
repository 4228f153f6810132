#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "pcrb_core/parallel.hpp"
#include "registration/ppcr_steps.hpp"

namespace pcrb {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Candidates beyond those needed: more make a search dearer, and rarer.
std::size_t rememberedFor(std::size_t neighbors, std::size_t target_size) {
  return std::min(neighbors + std::max<std::size_t>(neighbors, 6), target_size);
}

bool nearer(const Neighbor& a, const Neighbor& b) {
  return a.squared_distance < b.squared_distance ||
         (a.squared_distance == b.squared_distance && a.index < b.index);
}

}  // namespace

PpcrAssociation::PpcrAssociation(const KdTree& target, std::size_t source_size,
                                 std::size_t neighbors, double cut_quantile, double radius,
                                 int threads)
    : target_(target),
      source_size_(source_size),
      neighbors_(std::min(neighbors, target.points().size())),
      remembered_(rememberedFor(neighbors, target.points().size())),
      cut_quantile_(cut_quantile),
      squared_radius_(static_cast<float>(radius * radius)),
      threads_(threads) {
  const std::size_t entries = blocks() * neighbors_ * kSourceLanes;
  pairs_.x.assign(entries, 0.0F);
  pairs_.y.assign(entries, 0.0F);
  pairs_.z.assign(entries, 0.0F);
  pairs_.kept.assign(entries, 0.0F);
  pairs_.candidates.assign(entries, 0);
  squared_distances_.assign(entries, kInfinity);
  candidates_.assign(source_size_ * remembered_, 0);
  anchors_.assign(source_size_, Eigen::Vector3f::Zero());
  reach_.assign(source_size_, -kInfinity);
}

bool PpcrAssociation::update(const Points& moved_source) {
  std::atomic<bool> changed{false};
  forBlocks(source_size_, threads_, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> nearest;
    bool block_changed = false;
    for (std::size_t i = begin; i < end; ++i) {
      findNearest(i, moved_source[i], nearest);
      block_changed |= store(i, nearest);
    }
    if (block_changed) changed = true;
  });
  const bool cut_changed = cut(cutLimit());
  return changed || cut_changed;
}

void PpcrAssociation::findNearest(std::size_t point, const Eigen::Vector3f& position,
                                  std::vector<Neighbor>& nearest) {
  if (!recall(point, position, nearest)) search(point, position, nearest);
}

bool PpcrAssociation::recall(std::size_t point, const Eigen::Vector3f& position,
                             std::vector<Neighbor>& nearest) const {
  constexpr float kRounding = 1e-5F;
  const float movement = (position - anchors_[point]).norm();
  const float certain = reach_[point] * (1.0F - kRounding) - movement;
  if (!(certain > 0.0F)) return false;
  const Points& target = target_.points();
  const std::uint32_t* candidates = &candidates_[point * remembered_];
  nearest.clear();
  for (std::size_t c = 0; c < remembered_; ++c) {
    const Neighbor neighbor{candidates[c], (target[candidates[c]] - position).squaredNorm()};
    if (nearest.size() == neighbors_) {
      if (!nearer(neighbor, nearest.back())) continue;
      nearest.pop_back();
    }
    nearest.insert(std::upper_bound(nearest.begin(), nearest.end(), neighbor, nearer), neighbor);
  }
  return nearest.back().squared_distance < certain * certain;
}

void PpcrAssociation::search(std::size_t point, const Eigen::Vector3f& position,
                             std::vector<Neighbor>& nearest) {
  target_.nearest(position, remembered_, nearest);
  const bool all = remembered_ == target_.points().size();
  anchors_[point] = position;
  reach_[point] = all ? kInfinity : std::sqrt(nearest.back().squared_distance);
  for (std::size_t c = 0; c < remembered_; ++c) {
    candidates_[point * remembered_ + c] = nearest[c].index;
  }
  std::sort(nearest.begin(), nearest.end(), nearer);
  nearest.resize(neighbors_);
}

bool PpcrAssociation::store(std::size_t point, const std::vector<Neighbor>& nearest) {
  const std::size_t first =
      (point / kSourceLanes) * neighbors_ * kSourceLanes + point % kSourceLanes;
  bool changed = false;
  for (std::size_t k = 0; k < neighbors_; ++k) {
    const std::size_t entry = first + k * kSourceLanes;
    const Eigen::Vector3f& y = target_.points()[nearest[k].index];
    changed |= pairs_.candidates[entry] != nearest[k].index;
    pairs_.candidates[entry] = nearest[k].index;
    pairs_.x[entry] = y.x();
    pairs_.y[entry] = y.y();
    pairs_.z[entry] = y.z();
    squared_distances_[entry] = nearest[k].squared_distance;
  }
  return changed;
}

// The quantile's squared distance, of the pairs within the radius.
float PpcrAssociation::cutLimit() {
  scratch_.clear();
  for (const float s : squared_distances_) {
    if (s <= squared_radius_ && s < kInfinity) scratch_.push_back(s);
  }
  if (scratch_.empty() || cut_quantile_ >= 1.0) return squared_radius_;
  const auto rank = static_cast<std::size_t>(cut_quantile_ * static_cast<double>(scratch_.size()));
  const auto place = scratch_.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(scratch_.begin(), place, scratch_.end());
  return *place;
}

bool PpcrAssociation::cut(float squared_limit) {
  bool changed = false;
  for (std::size_t entry = 0; entry < squared_distances_.size(); ++entry) {
    const float s = squared_distances_[entry];
    const float kept = s <= squared_limit && s < kInfinity ? 1.0F : 0.0F;
    changed |= kept != pairs_.kept[entry];
    pairs_.kept[entry] = kept;
  }
  return changed;
}

}  // namespace pcrb
