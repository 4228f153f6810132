#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <optional>
#include <string>

#include "bridge/answer_diagnosis.hpp"
#include "bridge/answer_source.hpp"
#include "bridge/bridge_parameters.hpp"
#include "bridge/frames.hpp"
#include "bridge/node_monitor.hpp"
#include "bridge/robot_inputs.hpp"
#include "bridge/scan_publisher.hpp"
#include "bridge/setup_check.hpp"
#include "pcrb_server/node_main.hpp"
#include "pcrb_server/server_connection.hpp"
#include "ros/notices.hpp"
#include "ros/topic_peers.hpp"

namespace pcrb {

/// Makes a localization node that knows nothing of the benchmark its client: gives it map, initial
/// pose and scans as a robot would, reads its poses, and submits the one on which they settle.
///
/// Single-threaded: every wait works off the callback queue.
class LocalizationBridge {
 public:
  LocalizationBridge(const BridgeParameters& parameters, ShutdownRequest& shutdown);

  /// Serves until the server says that the run is over, which is what it returns; false after a
  /// shutdown.
  /// @throws Error  naming every conflict: nodes that publish what the bridge publishes.
  bool run();

 private:
  using Condition = std::function<bool()>;
  using Description = std::function<std::string()>;

  /// The way of a problem. From each step but the last it goes back to the first when the server
  /// announces another problem.
  enum class Step {
    kWaitForMap,   ///< for the next problem and its target
    kWaitForNode,  ///< sends the map; until the node and the frame of its sensor are there
    kSettle,       ///< until the node has used the map and the initial pose; then calls `ready`
    kPlay,         ///< sends scans until an answer is accepted, and submits it
    kDrain         ///< until the node has finished its scans
  };

  /// What belongs to one problem, and ends with it.
  struct ServedProblem {
    ServedProblem();  ///< not implicit, so that clang takes it for std::optional in this class

    pcrb_msgs::ProblemConstPtr message;
    sensor_msgs::PointCloud2ConstPtr target;  ///< from the end of kWaitForMap on
    SensorMounting mounting;
    std::optional<Transform> guess;      ///< T_map_source
    std::optional<ScanPublisher> scans;  ///< from kPlay on
    bool was_called = false;             ///< the service ~after_first_scan
  };

  /// What the node that is there has had; another node has had nothing.
  struct NodeHistory {
    int restart_count = -1;                    ///< which node
    std::optional<ros::Time> settled_map;      ///< stamp of the map that it had time for
    bool was_waited_for_subscription = false;  ///< to the initial pose
  };

  void step();
  Step waitForMap();
  Step waitForNode();
  Step settle();
  Step play();
  Step drainNode();

  bool waitFor(const Condition& condition, double limit);
  bool waitWhileCurrent(const Condition& condition, const Description& what);
  bool waitWhileCurrent(const Condition& condition, const std::string& what);
  void pause(double seconds);
  bool isCurrent() const;
  void refuseConflicts();
  TopicGraph topicsOfOthers() const;
  void checkTopics();

  void takeTransform(const geometry_msgs::TransformStamped& transform);
  bool isMapDue() const { return published_map_ != served_->target->header.stamp; }
  void sendMap();
  bool bringUpNode();
  NodeHistory& history();
  void settleMap();
  bool findMounting();
  bool callBeforeProblem();
  void callAfterFirstScan();
  std::optional<Transform> initialPose() const;
  void sendInitialPose();
  bool isOptical() const;
  void refuseWrongSetup(const pcrb_msgs::SubmitPose::Request& request);
  void submit(pcrb_msgs::SubmitPose::Request request);
  NoAnswerCause causeOfNoAnswer(double cpu_time) const;
  void printDiagnosis() const;

  const BridgeParameters& parameters_;
  ShutdownRequest& shutdown_;
  ros::NodeHandle node_;
  RobotInputs inputs_;
  TfWatch tf_;
  NodeMonitor monitor_;
  ConflictingPublishers conflicts_;
  std::optional<AnswerSource> answers_;  ///< none where answers are read from tf
  ServerConnection server_;
  ros::Subscriber results_;

  Step step_ = Step::kWaitForMap;
  std::optional<ServedProblem> served_;
  pcrb_msgs::ProblemConstPtr newest_;       ///< that was or is being served
  std::optional<ros::Time> published_map_;  ///< stamp of the target that was sent as map
  NodeHistory history_;
  ResponseTime response_time_;  ///< of the node, from the problems so far
  bool was_answered_ = false;   ///< whether a problem had an answer
  Notice untaken_;              ///< inputs that no node takes
  Notice silent_;               ///< the topic of answers, on which no node publishes
  Notice tilted_;               ///< the IMU, which says level
  FailureLog failures_;
  MisalignmentCheck misalignment_;
};

}  // namespace pcrb
