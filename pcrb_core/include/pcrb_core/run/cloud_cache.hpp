#pragma once

#include <array>
#include <cstddef>
#include <list>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "pcrb_core/evaluation/metric.hpp"
#include "pcrb_core/point_cloud.hpp"

namespace pcrb {

/// A cloud in its target's local frame, with what was computed from it.
struct LoadedCloud {
  std::string name;  ///< path below the root
  std::string hash;  ///< of the file
  PointCloud cloud;
  bool has_viewpoint = false;
  Transform viewpoint = Transform::Identity();  ///< T_local_sensor
  std::shared_ptr<const Metric> metric;         ///< for a cloud that has been a source
};

/// Clouds by path and local origin, the least recently used dropped beyond a memory limit.
/// Not thread-safe.
class CloudCache {
 public:
  explicit CloudCache(std::size_t limit_bytes) : limit_bytes_(limit_bytes) {}

  using Key = std::pair<std::string, std::array<double, 3>>;

  std::shared_ptr<LoadedCloud> find(const Key& key);
  /// Replaces what was there under that key.
  void insert(const Key& key, std::shared_ptr<LoadedCloud> cloud);

 private:
  struct Entry {
    Key key;
    std::shared_ptr<LoadedCloud> cloud;
    std::size_t bytes;
  };

  void erase(std::list<Entry>::iterator entry);

  std::size_t limit_bytes_;
  std::size_t bytes_ = 0;
  std::list<Entry> entries_;  ///< most recently used first
  std::map<Key, std::list<Entry>::iterator> index_;
};

}  // namespace pcrb
