#include "bridge/bridge_parameters.hpp"

#include <filesystem>
#include <set>

#include "pcrb_server/message_conversion.hpp"
#include "pcrb_server/node_parameters.hpp"
#include "pcrb_server/parameter_table.hpp"
#include "ros/topic_peers.hpp"

namespace pcrb {

const ParameterTable kBridgeParameters{
    {"", "", "", "Topics"},
    {"map_topic", "/map", "", "topic of the map, sensor_msgs/PointCloud2, latched"},
    {"scan_topic", "/scan", "", "topic of the scans, sensor_msgs/PointCloud2"},
    {"initialpose_topic", "/initialpose", "",
     "topic of the initial pose, geometry_msgs/PoseWithCovarianceStamped"},
    {"pose_topic", "/pose", "",
     "topic of the node's answers, PoseStamped, PoseWithCovarianceStamped, TransformStamped "
     "(geometry_msgs) or Odometry (nav_msgs); tf: transforms map -> base or map -> odom"},
    {"imu_topic", "", "",
     "topic of an IMU: gravity, and the acceleration of speed; empty: not sent"},
    {"imu_rate", "100", "Hz", "rate of the IMU"},
    {"odometry_topic", "", "", "topic of odometry; empty: not sent"},
    {"odometry_rate", "50", "Hz", "rate of the odometry"},
    {"", "", "", "Frames and links of tf"},
    {"map_frame", "map", "", "frame of the map"},
    {"odom_frame", "odom", "", "frame of the odometry"},
    {"base_frame", "base_link", "", "frame of the robot's body"},
    {"scan_frame", "sensor", "", "frame of the scans"},
    {"answer_frame", "", "",
     "frame of which an answer is the pose that names none; empty: base_frame"},
    {"tf_map_odom", "none", "none|static|dynamic",
     "link from map to odom that the bridge publishes, as identity"},
    {"tf_odom_base", "static", "none|static|dynamic",
     "link from odom to base that the bridge publishes, as identity"},
    {"tf_base_scan", "static", "none|static|dynamic",
     "link from base to scan that the bridge publishes, as identity (none: the sensor's mounting "
     "is read from tf)"},
    {"optical", "auto", "auto|yes|no",
     "clouds whose z is the viewing direction, to be turned upright (auto: data set tum)"},
    {"", "", "", "Before the scans of a problem"},
    {"map_first", "true", "", "order of map and initial pose; false: the map follows"},
    {"map_settle", "1", "s", "pause after a new map"},
    {"map_file", "", "",
     "PCD file to which each map is written, of this run alone; $NAME and ${NAME:-other} are "
     "variables of the environment"},
    {"before_problem", "", "", "service (Empty or Trigger) that is called before each problem"},
    {"after_first_scan", "", "",
     "service (Empty or Trigger) that is called in each problem when its first scan was answered, "
     "or first_scan_settle is over: for nodes that locate the last scan that they have"},
    {"first_scan_settle", "0.5", "s", "time from the first scan to after_first_scan"},
    {"send_initialpose", "true", "", "initial guess of the problem, sent as initial pose"},
    {"initialpose_settle", "0.1", "s", "pause after the initial pose"},
    {"initialpose_covariance", "3dof", "3dof|6dof", "degrees of freedom with a covariance"},
    {"initialpose_translation", "0.5", "m", "standard deviation of the initial position"},
    {"initialpose_rotation", "0.26", "rad", "standard deviation of the initial orientation"},
    {"", "", "", "Scans and answers"},
    {"scan_period", "0.1", "s", "shortest time between two scans of a problem"},
    {"pace", "answers", "answers|rate",
     "the next scan of a problem comes when the one before was answered or is late, or every "
     "scan_period, as a sensor's: what the node misses counts as unanswered"},
    {"speed", "0", "m/s",
     "speed at which the robot moves straight on while it has a problem: scans, odometry, IMU and "
     "tf follow, for nodes that take the correction of the initial pose for motion"},
    {"scan_stamps", "even", "even|now",
     "stamps of scans, a scan_period apart or the times at which they are sent"},
    {"answer_limit", "1", "s",
     "time after which the next scan comes without an answer; twice the time that the newest "
     "answer took, if that is more"},
    {"finish_limit", "30", "s",
     "longest time that the node gets after the decision to finish the scans that it has; no "
     "runtime, but part of the server's ready_limit"},
    {"max_scans", "40", "", "number of scans of a problem"},
    {"match", "stamp", "stamp|arrival",
     "relation of an answer to its scan, equal stamps or the newest scan"},
    {"answer_delay", "0", "s", "time by which answers' stamps are later than their scans'"},
    {"settle", "stable", "first|nth|stable|deadline", "answer that is submitted"},
    {"settle_count", "3", "", "number of answers, for nth and stable"},
    {"settle_translation", "0.01", "m", "largest difference of stable answers' positions"},
    {"settle_rotation", "0.002", "rad", "largest difference of stable answers' orientations"},
    {"echo_tolerance", "1e-4", "m and rad",
     "difference from the initial pose below which a first answer does not count"},
    {"deadline_fraction", "0.9", "",
     "part of the time limit after which the last answer is submitted"},
    {"store_scans", "true", "",
     "answers to all scans, stored for the report: the error over scans, and what each rule of "
     "settle makes of them"},
    {"", "", "", "The node under test"},
    {"restart", "never", "never|target|problem",
     "restart of the node before a new target, before each problem"},
    {"restart_after", "3", "", "problems in a row without an answer before a restart, 0 = never"},
    {"restart_service", "node_supervisor/restart", "", "service (Trigger) that restarts the node"},
    {"start_limit", "60", "s", "time for the node to subscribe to the scans before a restart"},
    {"observers", kObservers, "",
     "beginnings of the names of nodes that may come and go: they are not under test"},
};

namespace {

constexpr double kLongTime = 3600.0;  // s
constexpr const char* kTf = "tf";     // ~pose_topic: answers are read from tf

TfLink readLink(NodeParameters& reader, const std::string& name) {
  const std::string link = reader.choice(name);
  if (link == "none") return TfLink::kNone;
  return link == "static" ? TfLink::kStatic : TfLink::kDynamic;
}

void readTopics(NodeParameters& reader, BridgeParameters& parameters) {
  parameters.map_topic = reader.string("map_topic");
  parameters.scan_topic = reader.string("scan_topic");
  parameters.initialpose_topic = reader.string("initialpose_topic");
  parameters.pose_topic = reader.string("pose_topic");
  if (parameters.pose_topic == kTf) parameters.pose_topic.clear();
  parameters.imu_topic = reader.string("imu_topic");
  parameters.imu_rate = reader.number("imu_rate", 0.1, 1000.0);
  parameters.odometry_topic = reader.string("odometry_topic");
  parameters.odometry_rate = reader.number("odometry_rate", 0.1, 1000.0);
  if (parameters.map_topic == parameters.scan_topic) {
    reader.addMistake("~map_topic and ~scan_topic: expected two different names");
  }
}

/// Old nodes put a slash in front of their frames; tf2 has none.
std::string readFrame(NodeParameters& reader, const std::string& name) {
  return withoutSlash(reader.string(name));
}

void readFrames(NodeParameters& reader, BridgeParameters& parameters) {
  parameters.map_frame = readFrame(reader, "map_frame");
  parameters.odom_frame = readFrame(reader, "odom_frame");
  parameters.base_frame = readFrame(reader, "base_frame");
  parameters.scan_frame = readFrame(reader, "scan_frame");
  parameters.answer_frame = readFrame(reader, "answer_frame");
  if (parameters.answer_frame.empty()) parameters.answer_frame = parameters.base_frame;
  const std::set<std::string> names{parameters.map_frame, parameters.odom_frame,
                                    parameters.base_frame};
  if (names.size() < 3 || names.count("") > 0 || parameters.scan_frame.empty()) {
    reader.addMistake("~map_frame, ~odom_frame, ~base_frame: expected three different names");
  }
  parameters.tf_map_odom = readLink(reader, "tf_map_odom");
  parameters.tf_odom_base = readLink(reader, "tf_odom_base");
  parameters.tf_base_scan = readLink(reader, "tf_base_scan");
  if (parameters.scan_frame == parameters.base_frame) parameters.tf_base_scan = TfLink::kNone;
  parameters.speed = reader.number("speed", 0.0, 10.0);
  const bool is_fixed = parameters.tf_odom_base == TfLink::kStatic;
  if (parameters.speed > 0.0 && is_fixed) parameters.tf_odom_base = TfLink::kDynamic;
  const std::string optical = reader.choice("optical");
  parameters.optical = optical == "auto"  ? BridgeParameters::Optical::kAuto
                       : optical == "yes" ? BridgeParameters::Optical::kYes
                                          : BridgeParameters::Optical::kNo;
}

AcceptanceRule::Kind ruleFromString(const std::string& text) {
  if (text == "first") return AcceptanceRule::Kind::kFirst;
  if (text == "nth") return AcceptanceRule::Kind::kNth;
  return text == "stable" ? AcceptanceRule::Kind::kStable : AcceptanceRule::Kind::kDeadline;
}

void readAnswers(NodeParameters& reader, BridgeParameters& parameters) {
  parameters.settle.kind = ruleFromString(reader.choice("settle"));
  parameters.settle.count = reader.integer("settle_count", 1, 100000);
  parameters.settle.translation = reader.number("settle_translation", 1e-12, 1e6);
  parameters.settle.rotation = reader.number("settle_rotation", 1e-12, 4.0);
  parameters.settle.echo_tolerance = reader.number("echo_tolerance", 0.0, 1.0);
  parameters.deadline_fraction = reader.number("deadline_fraction", 0.01, 0.99);
  parameters.finish_limit = reader.number("finish_limit", 0.0, kLongTime);
  parameters.scans.period = reader.number("scan_period", 0.01, kLongTime);
  parameters.scans.answer_limit = reader.number("answer_limit", parameters.scans.period, kLongTime);
  parameters.scans.max_scans = reader.integer("max_scans", 1, 100000);
  parameters.stores_scans = reader.boolean("store_scans");
  parameters.scans.keeps_rate = reader.choice("pace") == "rate";
  parameters.scans.match_by_stamp = reader.choice("match") == "stamp";
  parameters.has_even_stamps = reader.choice("scan_stamps") == "even";
  parameters.answer_delay = reader.number("answer_delay", -kLongTime, kLongTime);
  const bool is_counted = parameters.settle.kind == AcceptanceRule::Kind::kNth ||
                          parameters.settle.kind == AcceptanceRule::Kind::kStable;
  if (is_counted && parameters.settle.count > parameters.scans.max_scans) {
    reader.addMistake("~settle_count: found more than ~max_scans");
  }
}

std::string readMapFile(NodeParameters& reader) {
  std::string path = reader.string("map_file");
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
  parameters.is_map_first = reader.boolean("map_first");
  parameters.map_settle = reader.number("map_settle", 0.0, kLongTime);
  parameters.initialpose_settle = reader.number("initialpose_settle", 0.0, kLongTime);
  parameters.map_file = readMapFile(reader);
  parameters.send_initialpose = reader.boolean("send_initialpose");
  parameters.initialpose_translation = reader.number("initialpose_translation", 0.0, 1e6);
  parameters.initialpose_rotation = reader.number("initialpose_rotation", 0.0, 10.0);
  parameters.has_6dof_covariance = reader.choice("initialpose_covariance") == "6dof";
  parameters.before_problem = reader.string("before_problem");
  parameters.after_first_scan = reader.string("after_first_scan");
  parameters.first_scan_settle = reader.number("first_scan_settle", 0.0, kLongTime);
}

void readRestart(NodeParameters& reader, BridgeParameters& parameters) {
  using Restart = BridgeParameters::Restart;
  const std::string restart = reader.choice("restart");
  parameters.restart = restart == "never"    ? Restart::kNever
                       : restart == "target" ? Restart::kTarget
                                             : Restart::kProblem;
  parameters.restart_service = reader.string("restart_service");
  parameters.restart_after = reader.integer("restart_after", 0, 1000000);
  parameters.start_limit = reader.number("start_limit", 0.1, kLongTime);
  parameters.observers = reader.words("observers");
}

}  // namespace

BridgeParameters readBridgeParameters() {
  NodeParameters reader(kBridgeParameters);
  reader.addGroup("bridge_parameters");
  reader.addDefaults("recipe/bridge");
  reader.allowOwnParameter("recipe");  // what else a recipe says is for people
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
