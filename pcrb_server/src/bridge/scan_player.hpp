#pragma once

#include <pcrb_msgs/SubmitPose.h>

#include <deque>
#include <optional>
#include <string>

#include "bridge/answer_source.hpp"
#include "bridge/bridge_parameters.hpp"
#include "bridge/node_inputs.hpp"
#include "bridge/scan_sequence.hpp"
#include "bridge/stamp_clock.hpp"
#include "bridge/tf_links.hpp"
#include "bridge/tf_watch.hpp"

namespace pcrb {

/// One problem as it is put to a localization node.
struct ScanProblem {
  double time_limit = 0.0;                          ///< s
  PointCloud source;                                ///< as the server handed it out
  Transform T_scan_source = Transform::Identity();  ///< turns it into the scan that is sent
  Transform T_base_scan = Transform::Identity();    ///< how the sensor is mounted
  std::optional<Transform> initial_pose;            ///< T_map_base, if it was sent

  Transform T_base_source() const { return T_base_scan * T_scan_source; }
};

/// s on a clock that nobody sets.
double steadyNow();

/// Sends the scans of a problem and takes the node's answers, until they settle.
class ScanPlayer {
 public:
  ScanPlayer(const BridgeParameters& parameters, NodeInputs& inputs, TfLinks& links,
             const TfWatch& tf, StampClock& clock);

  void begin(const ScanProblem& problem);

  /// Poses that come from now on are none of a problem's.
  void end();

  /// Sends a scan if one is due; kSubmit and kGiveUp: the problem is decided.
  ScanSequence::Action step();

  /// s after which step() has something to do, if no pose comes.
  double patience() const;

  /// A pose that the node published: an answer, if it belongs to a scan of the problem.
  void take(const PublishedPose& pose);

  /// Takes the poses that tf has connected since they came, for which they have half a second: a
  /// node may publish the transform that its pose needs after it. Also part of step().
  void takeWaiting();

  /// s for which the node may still be working on a scan of the problem.
  double timeToFinish() const { return sequence_->timeToFinish(steadyNow()); }

  /// Whether the node said anything about the problem's scans that could be used.
  bool isAnswered() const;

  /// The decision; its pose is T_map_source.
  pcrb_msgs::SubmitPose::Request decision() const;

 private:
  struct Waiting {
    PublishedPose pose;
    double until;  ///< s, steady
  };

  bool use(const PublishedPose& pose);

  const BridgeParameters& parameters_;
  NodeInputs& inputs_;
  TfLinks& links_;
  const TfWatch& tf_;
  StampClock& clock_;
  ScanProblem problem_;
  NodePace pace_;
  std::optional<ScanSequence> sequence_;
  std::deque<Waiting> waiting_;  ///< poses that tf does not connect yet, oldest first
  std::string unusable_;         ///< why the newest pose could not be used, else empty
};

/// The clock's stamp for what is sent now, as ROS has it.
ros::Time stampNow(StampClock& clock);

}  // namespace pcrb
