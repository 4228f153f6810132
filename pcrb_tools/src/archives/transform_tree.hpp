#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "archives/bag_messages.hpp"
#include "pcrb_core/datasets/trajectory.hpp"

namespace pcrb_tools {

/// The transforms that bags have on /tf and /tf_static, over all of their time: unlike a tf buffer,
/// with a limit for gaps and in exact stamps.
class TransformTree {
 public:
  /// @throws InvalidFile  for transforms that are none, and a frame with two parents.
  explicit TransformTree(const BagMessages& bags);

  bool has(const std::string& frame) const;

  /// The last frame on the way up from one.
  std::string rootOf(const std::string& frame) const;

  /// Whether the transform between two frames changes in time; false if there is none.
  bool isMoving(const std::string& target, const std::string& source) const;

  /// T_target_source at a time. Transforms of /tf_static hold for all times, and so does one of
  /// which there is only one message.
  ///
  /// @param max_gap  between the two transforms of a moving link that are interpolated
  /// @throws InvalidFile  if the frames are not connected, naming those there are.
  pcrb::PoseLookup lookup(const std::string& target, const std::string& source, pcrb::Stamp stamp,
                          pcrb::Stamp max_gap) const;

  /// The stamps, ascending, of the link with the most transforms on the way between two frames.
  std::vector<pcrb::Stamp> stampsBetween(const std::string& target,
                                         const std::string& source) const;

  /// For messages: `map > odom > base_link, base_link > velodyne (static)`.
  std::string describe() const;

 private:
  struct Link {
    std::string parent;
    bool is_static = false;
    std::optional<pcrb::Trajectory> transforms;  ///< T_parent_child
  };

  /// The frames whose links lie on the way from the source up, and from the target up.
  std::pair<std::vector<std::string>, std::vector<std::string>> way(
      const std::string& target, const std::string& source) const;

  std::vector<std::string> chain(const std::string& frame) const;  ///< from it to its root

  /// T_ancestor_frame over the links of `frames`.
  pcrb::PoseLookup climb(const std::vector<std::string>& frames, pcrb::Stamp stamp,
                         pcrb::Stamp max_gap) const;

  std::map<std::string, Link> links_;  ///< by child
};

}  // namespace pcrb_tools
