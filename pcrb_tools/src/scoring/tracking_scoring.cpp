#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "common/process.hpp"
#include "common/progress.hpp"
#include "common/sequence_paths.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/evaluation/metric.hpp"
#include "pcrb_core/evaluation/trajectory_error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_server/playback/scene.hpp"
#include "scoring/recorded_poses.hpp"
#include "scoring/scoring_tool.hpp"
#include "scoring/tracking_report.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

/// `1311878220.377686160.pcd` or `urban05_1524185042111111111.pcd`.
std::optional<pcrb::Stamp> stampOfName(const std::string& name) {
  const std::string stem = fs::path(name).stem().string();
  if (const auto stamp =
          stem.find('.') != std::string::npos ? pcrb::parseStamp(stem) : std::nullopt) {
    return stamp;
  }
  const std::string digits = stem.substr(stem.rfind('_') + 1);
  const auto nanoseconds = pcrb::parseInt(digits);
  return digits.size() == 19 ? nanoseconds : std::nullopt;
}

pcrb::ScanList listOf(const TrackingOptions& options) {
  if (!options.scans.empty()) return pcrb::readScanList(options.scans);
  pcrb::ScanList list;
  for (const std::string& name : openSequenceFolder(options.folder).clouds) {
    const auto stamp = stampOfName(name);
    if (!stamp) {
      throw pcrb::InvalidFile(options.folder + "/" + name, 0, "a name without a timestamp",
                              "--scans, the list that sequence_to_bag and replay write");
    }
    list.scans.emplace(*stamp, name);
  }
  return list;
}

pcrb::DatasetCloud readScan(const TrackingOptions& options, const std::string& name) {
  const std::string path = options.folder + "/" + name;
  pcrb::DatasetCloud cloud = pcrb::readPcd(path);
  if (!cloud.hasViewpoint()) {
    throw pcrb::InvalidFile(path, 0, "no VIEWPOINT", "the sensor's true pose");
  }
  return cloud;
}

/// One scan against its pose, both relative to an origin near the scan.
void score(const pcrb::DatasetCloud& cloud, const pcrb::ScanList& list,
           const pcrb::Transform& T_map_sensor, TrackedScan& scan) {
  const Eigen::Vector3d origin = pcrb::chooseLocalOrigin(cloud);
  const auto inLocal = [&origin](pcrb::Transform T) {
    T.translation() -= origin;
    return T;
  };
  pcrb::Transform estimate = T_map_sensor;
  estimate.translation() += list.local_origin;
  const pcrb::Metric metric(pcrb::makeLocal(cloud, origin));
  scan.error = metric.evaluate(inLocal(estimate) * inLocal(cloud.viewpoint).inverse());
  scan.T_map_sensor = T_map_sensor;
}

TrackedScan track(const TrackingOptions& options, const pcrb::ScanList& list,
                  const pcrb::Trajectory& trajectory, pcrb::Stamp stamp, const std::string& name) {
  const pcrb::DatasetCloud cloud = readScan(options, name);
  TrackedScan scan;
  scan.name = name;
  scan.stamp = stamp;
  scan.truth = cloud.viewpoint;
  scan.truth.translation() -= list.local_origin;
  const pcrb::StampedPose& nearest = trajectory.nearest(stamp);
  if (std::abs(nearest.stamp - stamp) <= pcrb::toStamp(options.max_difference)) {
    score(cloud, list, nearest.T_world_body * options.T_body_sensor, scan);
  }
  return scan;
}

}  // namespace

void runTrackingScoring(const TrackingOptions& options, std::ostream& out) {
  const Interruption interruption;
  const pcrb::ScanList list = listOf(options);
  const pcrb::Trajectory trajectory =
      toTrajectory(readPoses(options.poses.path, options.poses.topic, options.poses.map_frame),
                   options.poses.path);
  std::vector<TrackedScan> scans;
  Progress progress(fs::path(options.folder).filename().string(), "scans", list.scans.size());
  for (const auto& [stamp, name] : list.scans) {
    Interruption::check();
    scans.push_back(track(options, list, trajectory, stamp, name));
    progress.add();
  }
  progress.finish();
  const std::string summary = summarizeTracking(scans, options.delta, options.align);
  fs::create_directories(options.output);
  pcrb::writeFileAtomically(options.output + "/scans.csv", formatScansCsv(scans));
  pcrb::writeFileAtomically(options.output + "/truth.tum", formatTruthTum(scans));
  pcrb::writeFileAtomically(options.output + "/estimate.tum", formatEstimateTum(scans));
  pcrb::writeFileAtomically(options.output + "/summary.txt", summary);
  out << summary << std::flush;
}

}  // namespace pcrb_tools
