#pragma once

#include <string>
#include <vector>

#include "bridge/scan_schedule.hpp"
#include "pcrb_core/run/convergence_monitor.hpp"
#include "pcrb_server/parameter_table.hpp"

namespace pcrb {

/// Publication of a tf link by the bridge.
enum class TfLink {
  kNone,    ///< by another node, or not at all
  kStatic,  ///< once, latched on /tf_static
  kDynamic  ///< on /tf with every scan's stamp, sent before the scan
};

/// Parameters of `localization_bridge`; its --help says what each means.
struct BridgeParameters {
  std::string map_topic, scan_topic, initialpose_topic;
  std::string pose_topic;                 ///< empty: answers are read from tf
  std::string imu_topic, odometry_topic;  ///< empty: not sent
  double imu_rate = 100.0;                ///< Hz
  double odometry_rate = 50.0;            ///< Hz

  std::string map_frame, odom_frame, base_frame, scan_frame;
  std::string answer_frame;  ///< of which an answer is the pose that names none
  TfLink tf_map_odom = TfLink::kNone;
  TfLink tf_odom_base = TfLink::kStatic;
  TfLink tf_base_scan = TfLink::kStatic;
  enum class Optical { kAuto, kYes, kNo } optical = Optical::kAuto;

  double speed = 0.0;  ///< m/s, of the robot while it has a problem

  AcceptanceRule settle;
  ScanPolicy scans;  ///< the deadline is set for each problem
  double deadline_fraction = 0.9;
  bool stores_scans = true;
  double finish_limit = 30.0;  ///< s that a node gets to finish its scans after the decision
  bool has_even_stamps = true;
  double answer_delay = 0.0;  ///< s, by which the stamps of answers are later than their scans'

  bool is_map_first = true;
  double map_settle = 1.0;          ///< s from a new map to what follows it
  double initialpose_settle = 0.1;  ///< s from the initial pose to what follows it
  std::string map_file;             ///< empty: none
  bool send_initialpose = true;
  double initialpose_translation = 0.5;  ///< m, standard deviation
  double initialpose_rotation = 0.26;    ///< rad, standard deviation
  bool has_6dof_covariance = false;
  std::string before_problem;      ///< service, empty: none
  std::string after_first_scan;    ///< service, empty: none
  double first_scan_settle = 0.5;  ///< s from the first scan to that call, if no answer comes

  enum class Restart { kNever, kTarget, kProblem } restart = Restart::kNever;
  std::string restart_service;
  int restart_after = 3;               ///< problems in a row without an answer, 0 = never
  double start_limit = 60.0;           ///< s for a node to be there after a start
  std::vector<std::string> observers;  ///< beginnings of names of nodes that are not under test
};

/// All private parameters.
extern const ParameterTable kBridgeParameters;

/// Reads and checks them.
/// @throws InvalidParameter  listing every mistake.
BridgeParameters readBridgeParameters();

}  // namespace pcrb
