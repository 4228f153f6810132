#include "bridge/setup_check.hpp"

#include <algorithm>
#include <iterator>

#include "pcrb_core/io/text.hpp"

namespace pcrb {

namespace {

/// Arguments of localization.launch among the bridge's parameters.
const std::set<std::string> kLaunchArguments{"map_topic",         "scan_topic", "pose_topic",
                                             "initialpose_topic", "map_frame",  "base_frame",
                                             "scan_frame",        "settle",     "restart"};

/// The topic of a map has that in its name, and that of scans has not.
std::string likeliest(const std::map<std::string, std::string>& wanted, const RobotTopic& input) {
  const bool is_map = input.parameter == "map_topic";
  const auto found = std::find_if(wanted.begin(), wanted.end(), [&](const auto& topic) {
    return (topic.first.find("map") != std::string::npos) == is_map;
  });
  return found == wanted.end() ? wanted.begin()->first : found->first;
}

}  // namespace

std::map<std::string, std::string> TopicGraph::wanted(const std::string& type) const {
  std::map<std::string, std::set<std::string>> nodes;
  for (const auto& [topic, node] : subscribers) {
    const auto known = types.find(topic);
    const bool is_of_type = known != types.end() && known->second == type;
    if (is_of_type && publishers.count(topic) == 0) nodes[topic].insert(node);
  }
  std::map<std::string, std::string> shown;
  for (const auto& [topic, names] : nodes) {
    shown[topic] = topic + " (by " + joined(names, " ") + ")";
  }
  return shown;
}

std::string howToSet(const std::string& parameter, const std::string& value) {
  if (kLaunchArguments.count(parameter) > 0) return parameter + ":=" + value;
  return "`" + parameter + ": " + value + "` in bridge_parameters";
}

std::string describeUntaken(const std::vector<RobotTopic>& untaken, const TopicGraph& graph) {
  std::string text;
  bool is_wanted_elsewhere = false;
  for (const auto& input : untaken) {
    text += (text.empty() ? "" : "\n") + ("no node subscribes to " + input.topic) + " (" +
            input.parameter + ")";
    const auto wanted = graph.wanted(input.type);
    if (wanted.empty()) continue;
    is_wanted_elsewhere = true;
    std::vector<std::string> topics;
    std::transform(wanted.begin(), wanted.end(), std::back_inserter(topics),
                   [](const auto& topic) { return topic.second; });
    text += "; nodes wait for " + input.type + " on " + joined(topics) + ": set " +
            howToSet(input.parameter, likeliest(wanted, input)) +
            (wanted.size() > 1 ? " or so" : "");
  }
  if (!is_wanted_elsewhere) return text;
  return text +
         "\npcrb probe finds out what a node takes; pcrb recipes lists the nodes that are known";
}

std::string describeWait(const std::string& scan_topic, const std::vector<RobotTopic>& untaken,
                         const TopicGraph& graph) {
  const std::string wait = "waiting for a node that subscribes to " + scan_topic;
  const bool is_any_wanted =
      std::any_of(untaken.begin(), untaken.end(),
                  [&](const RobotTopic& input) { return !graph.wanted(input.type).empty(); });
  if (is_any_wanted) return wait + "\n" + describeUntaken(untaken, graph);
  return wait + "; no node waits for such messages on another topic: has it started?";
}

std::string adviceOnMounting(const std::string& base, const std::string& scan,
                             const std::set<std::string>& frames) {
  std::vector<std::string> shown;
  std::copy_if(frames.begin(), frames.end(), std::back_inserter(shown),
               [](const std::string& frame) { return !startsWith(frame, "pcrb_"); });
  const std::string known = shown.empty() ? "nothing is on tf" : "on tf are " + joined(shown, " ");
  return known + ": start what publishes the link, set " + howToSet("tf_base_scan", "static") +
         " if " + scan + " is where " + base + " is, or other frames (base_frame, scan_frame)";
}

}  // namespace pcrb
