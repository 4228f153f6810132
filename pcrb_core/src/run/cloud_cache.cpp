#include "pcrb_core/run/cloud_cache.hpp"

#include <iterator>

namespace pcrb {

namespace {

/// Memory of a cloud and of the metric that may be computed from it (4 doubles a point).
std::size_t bytesOf(const LoadedCloud& loaded) {
  return loaded.cloud.size() * (sizeof(Eigen::Vector3f) + 4 * sizeof(double)) +
         loaded.cloud.intensity.size() * sizeof(float);
}

}  // namespace

std::shared_ptr<LoadedCloud> CloudCache::find(const Key& key) {
  const auto found = index_.find(key);
  if (found == index_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, found->second);
  return found->second->cloud;
}

void CloudCache::insert(const Key& key, std::shared_ptr<LoadedCloud> cloud) {
  const auto known = index_.find(key);
  if (known != index_.end()) erase(known->second);
  const std::size_t bytes = bytesOf(*cloud);
  entries_.push_front({key, std::move(cloud), bytes});
  index_[key] = entries_.begin();
  bytes_ += bytes;
  while (bytes_ > limit_bytes_ && entries_.size() > 1) erase(std::prev(entries_.end()));
}

void CloudCache::erase(std::list<Entry>::iterator entry) {
  bytes_ -= entry->bytes;
  index_.erase(entry->key);
  entries_.erase(entry);
}

}  // namespace pcrb
