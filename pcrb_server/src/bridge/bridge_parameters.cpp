#include "bridge/bridge_parameters.hpp"

#include <filesystem>
#include <set>

#include "expand_variables.hpp"
#include "pcrb_server/node_parameters.hpp"
#include "subscriber_names.hpp"

namespace pcrb {

namespace {

constexpr double kLongTime = 3600.0;  // s
constexpr const char* kTf = "tf";     // ~pose_topic: answers are read from tf

TfLink readLink(NodeParameters& reader, const std::string& name, const std::string& fallback) {
  const std::string link = reader.choice(name, fallback, {"none", "static", "dynamic"});
  if (link == "none") return TfLink::kNone;
  return link == "static" ? TfLink::kStatic : TfLink::kDynamic;
}

void readTopics(NodeParameters& reader, BridgeParameters& parameters) {
  parameters.map_topic = reader.string("map_topic", "/map");
  parameters.scan_topic = reader.string("scan_topic", "/scan");
  parameters.initialpose_topic = reader.string("initialpose_topic", "/initialpose");
  parameters.pose_topic = reader.string("pose_topic", "/pose");
  if (parameters.pose_topic == kTf) parameters.pose_topic.clear();
  parameters.imu_topic = reader.string("imu_topic", "");
  parameters.imu_rate = reader.number("imu_rate", 100.0, 0.1, 1000.0);
  parameters.odometry_topic = reader.string("odometry_topic", "");
  parameters.odometry_rate = reader.number("odometry_rate", 50.0, 0.1, 1000.0);
  if (parameters.map_topic == parameters.scan_topic) {
    reader.addMistake("~map_topic and ~scan_topic: expected two different names");
  }
}

void readFrames(NodeParameters& reader, BridgeParameters& parameters) {
  parameters.map_frame = reader.string("map_frame", "map");
  parameters.odom_frame = reader.string("odom_frame", "odom");
  parameters.base_frame = reader.string("base_frame", "base_link");
  parameters.scan_frame = reader.string("scan_frame", "sensor");
  parameters.answer_frame = reader.string("answer_frame", parameters.base_frame);
  const std::set<std::string> names{parameters.map_frame, parameters.odom_frame,
                                    parameters.base_frame};
  if (names.size() < 3 || names.count("") > 0 || parameters.scan_frame.empty()) {
    reader.addMistake("~map_frame, ~odom_frame, ~base_frame: expected three different names");
  }
  parameters.tf_map_odom = readLink(reader, "tf_map_odom", "none");
  parameters.tf_odom_base = readLink(reader, "tf_odom_base", "static");
  parameters.tf_base_scan = readLink(reader, "tf_base_scan", "static");
  if (parameters.scan_frame == parameters.base_frame) parameters.tf_base_scan = TfLink::kNone;
  const std::string optical = reader.choice("optical", "auto", {"auto", "yes", "no"});
  parameters.optical = optical == "auto"  ? BridgeParameters::Optical::kAuto
                       : optical == "yes" ? BridgeParameters::Optical::kYes
                                          : BridgeParameters::Optical::kNo;
}

SettlingRule::Kind ruleFromString(const std::string& text) {
  if (text == "first") return SettlingRule::Kind::kFirst;
  if (text == "nth") return SettlingRule::Kind::kNth;
  return text == "stable" ? SettlingRule::Kind::kStable : SettlingRule::Kind::kDeadline;
}

void readAnswers(NodeParameters& reader, BridgeParameters& parameters) {
  parameters.settle.kind =
      ruleFromString(reader.choice("settle", "stable", {"first", "nth", "stable", "deadline"}));
  parameters.settle.count = reader.integer("settle_count", 3, 1, 100000);
  parameters.settle.translation = reader.number("settle_translation", 0.01, 1e-12, 1e6);
  parameters.settle.rotation = reader.number("settle_rotation", 0.002, 1e-12, 4.0);
  parameters.settle.echo_tolerance = reader.number("echo_tolerance", 1e-4, 0.0, 1.0);
  parameters.deadline_fraction = reader.number("deadline_fraction", 0.9, 0.01, 0.99);
  parameters.finish_limit = reader.number("finish_limit", 30.0, 0.0, kLongTime);
  parameters.scans.period = reader.number("scan_period", 0.1, 0.01, kLongTime);
  parameters.scans.answer_limit =
      reader.number("answer_limit", 1.0, parameters.scans.period, kLongTime);
  parameters.scans.max_scans = reader.integer("max_scans", 40, 1, 100000);
  parameters.scans.match_by_stamp =
      reader.choice("match", "stamp", {"stamp", "arrival"}) == "stamp";
  parameters.has_even_stamps = reader.choice("scan_stamps", "even", {"even", "now"}) == "even";
  parameters.answer_delay = reader.number("answer_delay", 0.0, -kLongTime, kLongTime);
  const bool is_counted = parameters.settle.kind == SettlingRule::Kind::kNth ||
                          parameters.settle.kind == SettlingRule::Kind::kStable;
  if (is_counted && parameters.settle.count > parameters.scans.max_scans) {
    reader.addMistake("~settle_count: found more than ~max_scans");
  }
}

std::string readMapFile(NodeParameters& reader) {
  std::string path = reader.string("map_file", "");
  reader.check([&] { path = expandVariables("~map_file", path); });
  if (path.empty()) return path;
  const std::string mistake = relativePathMistake("map_file", path);
  if (!mistake.empty()) {
    reader.addMistake("~map_file: " + mistake);
    return path;
  }
  const auto folder = std::filesystem::path(path).parent_path();
  if (!std::filesystem::is_directory(folder)) {
    reader.addMistake("~map_file: found no folder `" + folder.string() + "`");
  }
  return path;
}

void readStart(NodeParameters& reader, BridgeParameters& parameters) {
  parameters.is_map_first = reader.boolean("map_first", true);
  parameters.map_settle = reader.number("map_settle", 1.0, 0.0, kLongTime);
  parameters.initialpose_settle = reader.number("initialpose_settle", 0.1, 0.0, kLongTime);
  parameters.map_file = readMapFile(reader);
  parameters.send_initialpose = reader.boolean("send_initialpose", true);
  parameters.initialpose_translation = reader.number("initialpose_translation", 0.5, 0.0, 1e6);
  parameters.initialpose_rotation = reader.number("initialpose_rotation", 0.26, 0.0, 10.0);
  parameters.has_6dof_covariance =
      reader.choice("initialpose_covariance", "3dof", {"3dof", "6dof"}) == "6dof";
  parameters.before_problem = reader.string("before_problem", "");
}

void readRestart(NodeParameters& reader, BridgeParameters& parameters) {
  using Restart = BridgeParameters::Restart;
  const std::string restart = reader.choice("restart", "never", {"never", "target", "problem"});
  parameters.restart = restart == "never"    ? Restart::kNever
                       : restart == "target" ? Restart::kTarget
                                             : Restart::kProblem;
  parameters.restart_service = reader.string("restart_service", "node_supervisor/restart");
  parameters.restart_after = reader.integer("restart_after", 3, 0, 1000000);
  parameters.start_limit = reader.number("start_limit", 60.0, 0.1, kLongTime);
  parameters.observers = reader.words("observers", kObservers);
}

}  // namespace

BridgeParameters readBridgeParameters() {
  NodeParameters reader;
  BridgeParameters parameters;
  readTopics(reader, parameters);
  readFrames(reader, parameters);
  readAnswers(reader, parameters);
  readStart(reader, parameters);
  readRestart(reader, parameters);
  reader.finish();
  return parameters;
}

}  // namespace pcrb
