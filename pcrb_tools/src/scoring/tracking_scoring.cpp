#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/process.hpp"
#include "common/progress.hpp"
#include "common/sequence_paths.hpp"
#include "pcrb_core/datasets/cloud_file.hpp"
#include "pcrb_core/datasets/stamp_mismatch.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_server/playback/scene.hpp"
#include "scoring/quaternion_order.hpp"
#include "scoring/scoring_tool.hpp"
#include "scoring/tracked_poses.hpp"
#include "scoring/tracking_tables.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

void requireMatches(const std::vector<TrackedScan>& scans, const pcrb::Trajectory& trajectory) {
  std::vector<pcrb::Stamp> stamps;
  for (const TrackedScan& scan : scans) {
    if (scan.T_map_sensor) return;
    stamps.push_back(scan.stamp);
  }
  throw pcrb::InvalidParameter("found a pose for none of " + std::to_string(scans.size()) +
                               " scans (" + pcrb::describeMismatch(stamps, trajectory.stamps()) +
                               "), expected some with timestamps like the scans' "
                               "(--max-difference, --time-offset)");
}

pcrb::ScanList listOf(const TrackingOptions& options) {
  if (!options.scans.empty()) return pcrb::readScanList(options.scans);
  pcrb::ScanList list;
  for (const std::string& name : openSequenceFolder(options.folder).clouds) {
    const auto stamp = pcrb::stampOfFileName(name);
    if (!stamp) {
      throw pcrb::InvalidFile(options.folder + "/" + name, 0, "a name without a timestamp",
                              "--scans, the list that sequence_to_bag and replay write");
    }
    list.scans.emplace(*stamp, name);
  }
  return list;
}

[[noreturn]] void refuseWithoutViewpoint(const std::string& path) {
  throw pcrb::InvalidFile(
      path, 0, "no VIEWPOINT",
      "the sensor's true pose (the identity needs the header's comment `# VIEWPOINT is "
      "the sensor's pose`)");
}

/// One scan against a pose, both relative to an origin near the scan.
pcrb::PoseError errorOf(const pcrb::DatasetCloud& cloud, const pcrb::ScanList& list,
                        const pcrb::Transform& T_map_sensor) {
  const Eigen::Vector3d origin = pcrb::chooseLocalOrigin(cloud);
  const auto inLocal = [&origin](pcrb::Transform T) {
    T.translation() -= origin;
    return T;
  };
  pcrb::Transform estimate = T_map_sensor;
  estimate.translation() += list.local_origin;
  const pcrb::Metric metric(pcrb::makeLocal(cloud, origin));
  return metric.evaluate(inLocal(estimate) * inLocal(cloud.viewpoint).inverse());
}

/// Where the scans' points are, from above: occupied squares of a grid in the map's frame.
class TopView {
 public:
  void add(const pcrb::DatasetCloud& cloud, const Eigen::Vector3d& local_origin) {
    for (const auto& point : cloud.points) {
      const Eigen::Vector3d p = (point - local_origin) / kSquare;
      squares_.insert({std::floor(p.x()), std::floor(p.y())});
    }
  }

  /// `x,y` of each square's middle, m.
  std::string csv() const {
    std::string text = "x,y\n";
    for (const auto& [x, y] : squares_) {
      pcrb::appendShortest(text, (x + 0.5) * kSquare);
      text += ',';
      pcrb::appendShortest(text, (y + 0.5) * kSquare);
      text += '\n';
    }
    return text;
  }

 private:
  static constexpr double kSquare = 0.5;  // m
  std::set<std::pair<double, double>> squares_;
};

/// The scans and their true poses; no estimate yet.
std::vector<TrackedScan> readTruth(const TrackingOptions& options, const pcrb::ScanList& list) {
  std::vector<TrackedScan> scans;
  for (const auto& [stamp, name] : list.scans) {
    TrackedScan scan;
    scan.name = name;
    scan.stamp = stamp;
    const std::string path = options.folder + "/" + name;
    const auto viewpoint = pcrb::readViewpoint(path);
    if (!viewpoint) refuseWithoutViewpoint(path);
    scan.truth = *viewpoint;
    scan.truth.translation() -= list.local_origin;
    scans.push_back(std::move(scan));
  }
  return scans;
}

void track(const TrackingOptions& options, const pcrb::ScanList& list,
           const pcrb::Trajectory& trajectory, TrackedScan& scan,
           std::optional<pcrb::Transform>& last, TopView& view) {
  const pcrb::DatasetCloud cloud = pcrb::readPcd(options.folder + "/" + scan.name);
  view.add(cloud, list.local_origin);
  const pcrb::StampedPose& nearest = trajectory.nearest(scan.stamp);
  if (std::abs(nearest.stamp - scan.stamp) <= pcrb::toStamp(options.max_difference)) {
    scan.T_map_sensor = nearest.T_world_body * options.T_body_sensor;
    scan.error = errorOf(cloud, list, *scan.T_map_sensor);
    last = scan.T_map_sensor;
  }
  if (!last) last = scan.truth;  // a tracker gets the first pose
  scan.held_error = scan.error ? scan.error->error : errorOf(cloud, list, *last).error;
}

/// The trajectory in the scans' time.
pcrb::Trajectory inScansTime(const TrackingOptions& options, const std::vector<TrackedScan>& scans,
                             pcrb::Trajectory trajectory, std::vector<std::string>& notes) {
  double offset = options.time_offset;
  if (options.largest_offset > 0.0) {
    std::vector<pcrb::StampedPose> truth;
    for (const TrackedScan& scan : scans) truth.push_back({scan.stamp, scan.truth});
    offset += estimateTimeOffset(truth, shifted(trajectory, offset), options.T_body_sensor,
                                 options.largest_offset);
    notes.push_back("time offset estimated: " + pcrb::formatFixed(offset, 6) +
                    " s added to the poses' timestamps");
  }
  return offset == 0.0 ? trajectory : shifted(trajectory, offset);
}

std::vector<ReadRotation> rotationsOf(const Matched& matched) {
  std::vector<ReadRotation> rotations;
  for (std::size_t i = 0; i != matched.truth.size(); ++i) {
    rotations.push_back(
        {matched.truth[i].linear(), Eigen::Quaterniond(matched.estimate[i].linear())});
  }
  return rotations;
}

}  // namespace

bool runTrackingScoring(const TrackingOptions& options, std::ostream& out) {
  const Interruption interruption;
  const pcrb::ScanList list = listOf(options);
  std::vector<std::string> notes;
  pcrb::Trajectory read = readTrackedPoses(options, list, notes);
  std::vector<TrackedScan> scans = readTruth(options, list);
  const pcrb::Trajectory trajectory = inScansTime(options, scans, std::move(read), notes);
  std::optional<pcrb::Transform> last;
  TopView view;
  Progress progress(fs::path(options.folder).filename().string(), "scans", list.scans.size());
  for (TrackedScan& scan : scans) {
    Interruption::check();
    track(options, list, trajectory, scan, last, view);
    progress.add();
  }
  progress.finish();
  requireMatches(scans, trajectory);
  const std::string hint = orderHint(rotationsOf(match(scans)));
  if (!hint.empty()) notes.push_back(hint);
  std::string summary = summarizeTracking(scans, options);
  for (const std::string& note : notes) summary += "note: " + note + "\n";
  fs::create_directories(options.output);
  pcrb::writeFileAtomically(options.output + "/scans.csv", formatScansCsv(scans));
  pcrb::writeFileAtomically(options.output + "/truth.tum", formatTruthTum(scans));
  pcrb::writeFileAtomically(options.output + "/estimate.tum", formatEstimateTum(scans));
  pcrb::writeFileAtomically(options.output + "/map.csv", view.csv());
  pcrb::writeFileAtomically(options.output + "/summary.txt", summary);
  out << summary << std::flush;
  return isComplete(scans, options);
}

}  // namespace pcrb_tools
