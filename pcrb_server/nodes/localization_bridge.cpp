#include "bridge/localization_bridge.hpp"

#include "pcrb_server/node_main.hpp"

namespace {

const pcrb::NodeHelp kHelp{"localization_bridge",
                           "Makes an unchanged localization node a client of the benchmark: gives "
                           "it map, initial pose and scans, reads its poses, submits them.",
                           R"(Private parameters (default):
  map_topic (/map), scan_topic (/scan)  sensor_msgs/PointCloud2; the map is latched
  initialpose_topic (/initialpose)      geometry_msgs/PoseWithCovarianceStamped
  pose_topic (/pose)     the node's answers: PoseStamped, PoseWithCovarianceStamped, Odometry or
                         TransformStamped; `tf`: its transforms map -> base or map -> odom
  imu_topic, odometry_topic ('')  sent if named: gravity alone, no motion
  imu_rate (100), odometry_rate (50)  Hz
  map_frame (map), odom_frame (odom), base_frame (base_link), scan_frame (sensor)
  tf_map_odom (none), tf_odom_base (static), tf_base_scan (static)  none, static or dynamic:
                         the links of tf that the bridge publishes, as identity; with
                         tf_base_scan:=none the sensor's mounting is read from tf
  optical (auto)         yes: the clouds' z is the viewing direction and they are turned upright
                         (auto: data set tum)
  answer_frame (base_frame)  whose pose an answer is that does not name it
  map_first (true)       false: the map follows the initial pose
  map_settle (1), initialpose_settle (0.1)  s between a new map, an initial pose, and what follows
  map_file ('')          PCD file to which each map is written, of this run alone; $NAME and
                         ${NAME:-other} are variables of the environment
  send_initialpose (true); initialpose_covariance (3dof)  or 6dof
  initialpose_translation (0.5), initialpose_rotation (0.26)  standard deviations, m and rad
  before_problem ('')    service (Empty or Trigger) that is called before each problem
  scan_period (0.1)      s between a problem's scans, from 0.01
  scan_stamps (even)     even: a scan_period apart;  now: the times at which scans are sent
  answer_limit (1)       s after which the next scan comes without an answer; twice the time that
                         the newest answer took, if that is more
  finish_limit (30)      s, at most, that the node gets after the decision to finish the scans that
                         it has: until it answers the last, or nothing comes for twice the time of
                         its slowest answer; no runtime, but part of the server's ready_limit
  max_scans (40)         of a problem
  settle (stable)        first, nth, stable or deadline: which answer counts
  settle_count (3)       answers, for nth and stable
  settle_translation (0.01), settle_rotation (0.002)  m and rad, for stable
  echo_tolerance (1e-4)  m and rad: a first answer so near to the initial pose does not count
  deadline_fraction (0.9)  of the time limit, after which the last answer is submitted
  match (stamp)          an answer has its scan's stamp;  arrival: it is the newest scan's
  answer_delay (0)       s that answers' stamps are later than their scans'
  restart (never)        never, target or problem: before what the node is restarted
  restart_after (3)      problems in a row without an answer, 0 = never
  restart_service (node_supervisor/restart)
  start_limit (60)       s for the node to subscribe to the scan after a start; then it is restarted
  observers (rviz rqt rosbag rostopic rosout foxglove_bridge rosbridge_websocket)
                         what names of nodes begin with that may come and go: not under test

The benchmark's side: problem, target, source, summary; ready, submit_pose; in the namespace /pcrb
unless another is given. Ends when the server says that the run is over.)"};

}  // namespace

int main(int argc, char** argv) {
  return pcrb::runNode(argc, argv, kHelp, [](pcrb::ShutdownNotice& shutdown) {
    const pcrb::BridgeParameters parameters = pcrb::readBridgeParameters();
    return pcrb::LocalizationBridge(parameters, shutdown).run() ? 0 : 1;
  });
}
