#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "common/process.hpp"
#include "common/progress.hpp"
#include "common/sequence_paths.hpp"
#include "common/series_file.hpp"
#include "pcrb_core/datasets/cloud_file.hpp"
#include "pcrb_core/datasets/stamp.hpp"
#include "pcrb_core/datasets/stamp_mismatch.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/evaluation/metric.hpp"
#include "pcrb_core/evaluation/trajectory_error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/transform.hpp"
#include "pcrb_server/playback/scene.hpp"
#include "scoring/quaternion_order.hpp"
#include "scoring/scoring_tool.hpp"
#include "scoring/tracked_poses.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

constexpr double kDegree = 57.29577951308232;  // per rad

/// A scan of a sequence, and where a tracker thought it was.
struct TrackedScan {
  std::string name;
  pcrb::Stamp stamp = 0;
  pcrb::Transform truth = pcrb::Transform::Identity();  ///< T_map_sensor
  std::optional<pcrb::Transform> T_map_sensor;          ///< estimated; nothing = no pose
  std::optional<pcrb::PoseError> error;
  double held_error = 0.0;  ///< of the pose, or without one of the last pose before it
};

std::vector<double> inDegrees(std::vector<double> angles) {
  for (double& angle : angles) angle *= kDegree;
  return angles;
}

void appendTum(std::string& text, pcrb::Stamp stamp, const pcrb::Transform& T) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(T.linear()).normalized();
  const Eigen::Vector3d& t = T.translation();
  text += pcrb::formatStamp(stamp);
  for (const double number : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}) {
    text += ' ';
    pcrb::appendShortest(text, number);
  }
  text += '\n';
}

void appendRow(std::ostream& out, const std::string& name, const std::vector<double>& errors) {
  const pcrb::ErrorStatistics s = pcrb::describeErrors(errors);
  out << std::left << std::setw(20) << name << std::right << std::setw(6) << s.count;
  for (const double value : {s.rmse, s.mean, s.median, s.stddev, s.min, s.max, s.sse}) {
    out << "  " << std::setw(10)
        << (std::isnan(value) ? std::string("-") : pcrb::formatFixed(value, 6));
  }
  out << '\n';
}

/// Of the scans that have one.
struct Matched {
  pcrb::Poses truth;
  pcrb::Poses estimate;
  std::vector<double> errors;
  std::vector<double> held_errors;  ///< of all scans
};

Matched match(const std::vector<TrackedScan>& scans) {
  Matched matched;
  for (const TrackedScan& scan : scans) {
    matched.held_errors.push_back(scan.held_error);
    if (!scan.T_map_sensor) continue;
    matched.truth.push_back(scan.truth);
    matched.estimate.push_back(*scan.T_map_sensor);
    matched.errors.push_back(scan.error->error);
  }
  return matched;
}

/// One line per scan; without a pose its fields are empty.
std::string formatScansCsv(const std::vector<TrackedScan>& scans) {
  std::string text = kScansHeader + std::string("\n");
  for (const TrackedScan& scan : scans) {
    text += scan.name + ',' + pcrb::formatStamp(scan.stamp);
    if (scan.error) {
      for (const double value :
           {scan.error->error, scan.error->rotation_error, scan.error->translation_error}) {
        text += ',';
        pcrb::appendShortest(text, value);
      }
    } else {
      text += ",,,";
    }
    text += ',';
    pcrb::appendShortest(text, scan.held_error);
    text += '\n';
  }
  return text;
}

/// TUM's format, which evo reads, of the scans that have a pose.
std::string formatTruthTum(const std::vector<TrackedScan>& scans) {
  std::string text;
  for (const TrackedScan& scan : scans) {
    if (scan.T_map_sensor) appendTum(text, scan.stamp, scan.truth);
  }
  return text;
}

std::string formatEstimateTum(const std::vector<TrackedScan>& scans) {
  std::string text;
  for (const TrackedScan& scan : scans) {
    if (scan.T_map_sensor) appendTum(text, scan.stamp, *scan.T_map_sensor);
  }
  return text;
}

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

/// A table: the benchmark's error, APE and RPE with evo's statistics.
std::string summarizeTracking(const std::vector<TrackedScan>& scans,
                              const TrackingOptions& options) {
  const std::size_t delta = options.delta;
  const bool align = options.align;
  const Matched matched = match(scans);
  const auto absolute = pcrb::absolutePoseErrors(
      matched.truth,
      align ? pcrb::alignToReference(matched.truth, matched.estimate) : matched.estimate);
  const auto relative = pcrb::relativePoseErrors(matched.truth, matched.estimate, delta);
  std::ostringstream out;
  out << "scans " << scans.size() << ", with a pose " << matched.estimate.size() << "; APE "
      << (align ? "after a rigid alignment" : "without alignment") << ", RPE over " << delta
      << (delta == 1 ? " scan\n" : " scans\n");
  out << "                     count        rmse        mean      median      stddev         min"
         "         max         sse\n";
  appendRow(out, "error", matched.errors);
  appendRow(out, "error, lost held", matched.held_errors);
  appendRow(out, "APE translation m", absolute.translation);
  appendRow(out, "APE rotation deg", inDegrees(absolute.rotation));
  appendRow(out, "RPE translation m", relative.translation);
  appendRow(out, "RPE rotation deg", inDegrees(relative.rotation));
  const auto over_metres =
      pcrb::relativePoseErrorsOver(matched.truth, matched.estimate, options.metres);
  const std::string name = "RPE " + pcrb::formatShortest(options.metres) + " m ";
  appendRow(out, name + "m", over_metres.translation);
  appendRow(out, name + "deg", inDegrees(over_metres.rotation));
  const pcrb::Drift drift = pcrb::drift(matched.truth, matched.estimate);
  if (drift.segments > 0) {
    out << "drift over " << pcrb::formatShortest(drift.lengths.front()) << " to "
        << pcrb::formatShortest(drift.lengths.back()) << " m: t_rel "
        << pcrb::formatFixed(drift.translation_percent, 4) << " %, r_rel "
        << pcrb::formatFixed(drift.rotation_degrees_per_metre, 6) << " deg/m\n";
  }
  const std::size_t lost = scans.size() - matched.estimate.size();
  if (lost > 0) {
    out << "lost " << lost << " of " << scans.size()
        << " scans; in `lost held` each counts with the last pose before it\n";
  }
  return out.str();
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
  const auto lost = static_cast<double>(std::count_if(
      scans.begin(), scans.end(), [](const TrackedScan& scan) { return !scan.T_map_sensor; }));
  return lost <= options.max_lost * static_cast<double>(scans.size());
}

}  // namespace pcrb_tools
