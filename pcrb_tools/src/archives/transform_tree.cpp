#include "archives/transform_tree.hpp"

#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <set>

#include "pcrb_core/error.hpp"
#include "pcrb_server/message_conversion.hpp"

namespace pcrb_tools {
namespace {

constexpr const char* kTfTopic = "/tf";
constexpr const char* kTfStaticTopic = "/tf_static";

/// What is gathered of a frame before its trajectory is made.
struct Gathered {
  std::string parent;
  bool is_static = false;
  std::vector<pcrb::StampedPose> poses;
};

pcrb::Transform requireTransform(const geometry_msgs::TransformStamped& stamped) {
  try {
    return pcrb::fromMessage(stamped.transform);
  } catch (const pcrb::InvalidProblem& error) {
    throw pcrb::InvalidFile("tf " + stamped.header.frame_id + " > " + stamped.child_frame_id,
                            error.what());
  }
}

void gather(const geometry_msgs::TransformStamped& stamped, bool is_static,
            std::map<std::string, Gathered>& frames) {
  const std::string parent = pcrb::withoutSlash(stamped.header.frame_id);
  const std::string child = pcrb::withoutSlash(stamped.child_frame_id);
  Gathered& frame = frames[child];
  if (!frame.poses.empty() && frame.parent != parent) {
    throw pcrb::InvalidFile(
        "tf", 0, "two parents of `" + child + "`, `" + frame.parent + "` and `" + parent + "`",
        "one");
  }
  frame.parent = parent;
  frame.is_static |= is_static;
  frame.poses.push_back({pcrb::stampOf(stamped.header.stamp), requireTransform(stamped)});
}

}  // namespace

TransformTree::TransformTree(const BagMessages& bags) {
  std::map<std::string, Gathered> frames;
  bags.forEach({kTfTopic, kTfStaticTopic}, [&](const rosbag::MessageInstance& instance) {
    const bool is_static = instance.getTopic() == kTfStaticTopic;
    const auto message = messageAs<tf2_msgs::TFMessage>(instance);
    for (const auto& stamped : message->transforms) gather(stamped, is_static, frames);
  });
  for (auto& [child, gathered] : frames) {
    Link& link = links_[child];
    link.parent = gathered.parent;
    link.transforms.emplace(std::move(gathered.poses));
    link.is_static = gathered.is_static || link.transforms->size() == 1;
  }
}

bool TransformTree::has(const std::string& frame) const {
  return links_.count(frame) > 0 ||
         std::any_of(links_.begin(), links_.end(),
                     [&](const auto& link) { return link.second.parent == frame; });
}

std::vector<std::string> TransformTree::chain(const std::string& frame) const {
  std::vector<std::string> frames{frame};
  for (auto link = links_.find(frame); link != links_.end(); link = links_.find(frames.back())) {
    const std::string& parent = link->second.parent;
    if (std::count(frames.begin(), frames.end(), parent) > 0) {
      throw pcrb::InvalidFile("tf", 0, "a circle at `" + parent + "`", "a tree of frames");
    }
    frames.push_back(parent);
  }
  return frames;
}

std::string TransformTree::rootOf(const std::string& frame) const { return chain(frame).back(); }

std::pair<std::vector<std::string>, std::vector<std::string>> TransformTree::way(
    const std::string& target, const std::string& source) const {
  std::vector<std::string> up = chain(source);
  std::vector<std::string> down = chain(target);
  const auto meeting = std::find_first_of(up.begin(), up.end(), down.begin(), down.end());
  if (meeting == up.end()) {
    throw pcrb::InvalidFile("tf", 0,
                            "no way from `" + source + "` to `" + target + "` among " + describe(),
                            "frames that are connected");
  }
  const std::string common = *meeting;
  up.erase(meeting, up.end());
  down.erase(std::find(down.begin(), down.end(), common), down.end());
  return {std::move(up), std::move(down)};
}

bool TransformTree::isMoving(const std::string& target, const std::string& source) const {
  if (!has(target) || !has(source) || rootOf(target) != rootOf(source)) return false;
  const auto [up, down] = way(target, source);
  const auto moves = [&](const std::string& frame) { return !links_.at(frame).is_static; };
  return std::any_of(up.begin(), up.end(), moves) || std::any_of(down.begin(), down.end(), moves);
}

std::vector<pcrb::Stamp> TransformTree::stampsBetween(const std::string& target,
                                                      const std::string& source) const {
  auto [frames, down] = way(target, source);
  frames.insert(frames.end(), down.begin(), down.end());
  std::vector<pcrb::Stamp> most;
  for (const std::string& frame : frames) {
    const Link& link = links_.at(frame);
    if (!link.is_static && link.transforms->size() > most.size()) most = link.transforms->stamps();
  }
  return most;
}

pcrb::PoseLookup TransformTree::climb(const std::vector<std::string>& frames, pcrb::Stamp stamp,
                                      pcrb::Stamp max_gap) const {
  pcrb::PoseLookup answer{pcrb::PoseStatus::kFound, pcrb::Transform::Identity()};
  for (const std::string& frame : frames) {
    const Link& link = links_.at(frame);
    const pcrb::PoseLookup step =
        link.is_static ? pcrb::PoseLookup{pcrb::PoseStatus::kFound,
                                          link.transforms->nearest(stamp).T_world_body}
                       : link.transforms->interpolate(stamp, max_gap);
    if (step.status != pcrb::PoseStatus::kFound) return step;
    answer.T_world_body = step.T_world_body * answer.T_world_body;
  }
  return answer;
}

pcrb::PoseLookup TransformTree::lookup(const std::string& target, const std::string& source,
                                       pcrb::Stamp stamp, pcrb::Stamp max_gap) const {
  if (target == source) return {pcrb::PoseStatus::kFound, pcrb::Transform::Identity()};
  const auto [up, down] = way(target, source);
  pcrb::PoseLookup answer = climb(up, stamp, max_gap);
  if (answer.status != pcrb::PoseStatus::kFound) return answer;
  const pcrb::PoseLookup T_common_target = climb(down, stamp, max_gap);
  if (T_common_target.status != pcrb::PoseStatus::kFound) return T_common_target;
  answer.T_world_body = T_common_target.T_world_body.inverse() * answer.T_world_body;
  return answer;
}

std::string TransformTree::describe() const {
  if (links_.empty()) return "no transform on /tf or /tf_static";
  std::string text = "the transforms";
  for (const auto& [child, link] : links_) {
    text += " " + link.parent + " > " + child + (link.is_static ? " (static)" : "") + ",";
  }
  text.pop_back();
  return text;
}

}  // namespace pcrb_tools
