#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

/// What a node under test does on other topics than those that the bridge was told, for people.
namespace pcrb {

/// Something that the bridge sends, or waits for.
struct RobotTopic {
  std::string parameter;  ///< of the bridge, that names it
  std::string topic;
  std::string type;  ///< e.g. `sensor_msgs/PointCloud2`
};

/// Topics of ROS as the master knows them. Nodes that take no part (people's tools, this one) are
/// left out.
struct TopicGraph {
  std::map<std::string, std::string> types;  ///< by topic
  std::multimap<std::string, std::string> publishers;
  std::multimap<std::string, std::string> subscribers;  ///< nodes by topic

  /// Topics of a type that nodes take and none sends, each as `TOPIC (by NODE NODE…)`.
  std::map<std::string, std::string> wanted(const std::string& type) const;
};

/// How a parameter of the bridge is set: as an argument, `scan_topic:=/cloud`, where
/// localization.launch has it, else as an entry of the file that its argument bridge_parameters
/// names.
std::string howToSet(const std::string& parameter, const std::string& value);

/// A line for each input that no node takes: its topic, on which topics of its type nodes wait, and
/// what to type; empty if all are taken.
std::string describeUntaken(const std::vector<RobotTopic>& untaken, const TopicGraph& graph);

/// What people are told while no node takes the scans.
std::string describeWait(const std::string& scan_topic, const std::vector<RobotTopic>& untaken,
                         const TopicGraph& graph);

/// What the frames of tf are, and what to set, where no link from `base` to `scan` comes.
std::string adviceOnMounting(const std::string& base, const std::string& scan,
                             const std::set<std::string>& frames);

}  // namespace pcrb
