#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace pcrb {

/// Other nodes that do what the bridge does.
class Rivals {
 public:
  using IsObserver = std::function<bool(const std::string& node)>;

  /// @param owned        topics that nobody else may publish.
  /// @param initialpose  one for which people's tools have a button: rviz advertises it, and may.
  Rivals(std::vector<std::string> owned, std::string initialpose, IsObserver is_observer);

  /// Asks the master who publishes the topics.
  ///
  /// @param tf_rival  who publishes a tf frame that the bridge owns, and which, else empty.
  /// @throws Error    naming every rival, or if the master does not answer.
  void refuse(const std::string& tf_rival);

  /// From now on, who advertises the initial pose is warned of once and does not end the run.
  void beginRun() { has_begun_ = true; }

 private:
  bool isLetPass(const std::string& node, const std::string& topic);

  std::vector<std::string> owned_;
  std::string initialpose_;
  IsObserver is_observer_;
  bool has_begun_ = false;
  std::set<std::string> warned_;  ///< nodes
};

}  // namespace pcrb
