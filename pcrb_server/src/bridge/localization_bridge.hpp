#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <optional>
#include <string>

#include "bridge/answer_source.hpp"
#include "bridge/bridge_parameters.hpp"
#include "bridge/node_inputs.hpp"
#include "bridge/node_keeper.hpp"
#include "bridge/rivals.hpp"
#include "bridge/scan_player.hpp"
#include "bridge/stamp_clock.hpp"
#include "bridge/tf_links.hpp"
#include "bridge/tf_watch.hpp"
#include "pcrb_server/node_main.hpp"
#include "pcrb_server/server_connection.hpp"

namespace pcrb {

/// Makes a localization node that knows nothing of the benchmark its client: gives it map, initial
/// pose and scans as a robot would, reads its poses, and submits the one on which they settle.
///
/// Single-threaded: every wait works off the callback queue.
class LocalizationBridge {
 public:
  LocalizationBridge(const BridgeParameters& parameters, ShutdownNotice& shutdown);

  /// Serves until the server says that the run is over, which is what it returns; false after a
  /// shutdown.
  /// @throws Error  naming every rival: who else publishes what the bridge publishes.
  bool run();

 private:
  using Condition = std::function<bool()>;

  bool waitFor(const Condition& condition, double limit);
  bool waitWhileCurrent(const Condition& condition, const std::string& what);
  void pause(double seconds);
  bool isCurrent() const;
  void takeTransform(const geometry_msgs::TransformStamped& transform);

  void serve();
  bool takeTarget();
  bool prepareNode();
  void sendMap();
  bool bringNode();
  void settleMap();
  bool findMounting();
  bool callBeforeProblem();
  void sendInitialPose();
  bool isOptical() const;
  void play();
  void submit(pcrb_msgs::SubmitPose::Request request);
  void letNodeFinish();

  const BridgeParameters& parameters_;
  ShutdownNotice& shutdown_;
  ros::NodeHandle node_;
  NodeInputs inputs_;
  TfLinks links_;
  TfWatch tf_;
  StampClock clock_;
  ScanPlayer player_;
  NodeKeeper keeper_;
  Rivals rivals_;
  std::optional<AnswerSource> answers_;  ///< none where answers are read from tf
  ServerConnection server_;

  pcrb_msgs::ProblemConstPtr problem_;  ///< that is being served
  ros::Time target_stamp_;              ///< of the target that the map is
  PointCloud map_;
  bool is_map_due_ = false;             ///< whether it has to be sent
  std::optional<int> generation_;       ///< of the node that has the map
  std::optional<int> pose_generation_;  ///< of the node whose subscription was waited for
  ScanProblem scan_problem_;            ///< what is known of it so far
};

}  // namespace pcrb
