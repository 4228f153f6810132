#include <cmath>
#include <filesystem>
#include <iomanip>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "common/process.hpp"
#include "common/progress.hpp"
#include "common/sequence_paths.hpp"
#include "pcrb_core/datasets/stamp.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/evaluation/metric.hpp"
#include "pcrb_core/evaluation/trajectory_error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/transform.hpp"
#include "pcrb_server/playback/scene.hpp"
#include "scoring/recorded_poses.hpp"
#include "scoring/scoring_tool.hpp"

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
};

Matched match(const std::vector<TrackedScan>& scans) {
  Matched matched;
  for (const TrackedScan& scan : scans) {
    if (!scan.T_map_sensor) continue;
    matched.truth.push_back(scan.truth);
    matched.estimate.push_back(*scan.T_map_sensor);
    matched.errors.push_back(scan.error->error);
  }
  return matched;
}

/// One line per scan; without a pose its fields are empty.
std::string formatScansCsv(const std::vector<TrackedScan>& scans) {
  std::string text = "scan,stamp,error,rotation_error_rad,translation_error_m\n";
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

/// A table: the benchmark's error, APE and RPE with evo's statistics.
std::string summarizeTracking(const std::vector<TrackedScan>& scans, std::size_t delta,
                              bool align) {
  const Matched matched = match(scans);
  if (matched.estimate.empty()) {
    throw pcrb::InvalidParameter("found a pose for none of " + std::to_string(scans.size()) +
                                 " scans, expected some with timestamps like the scans'");
  }
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
  appendRow(out, "APE translation m", absolute.translation);
  appendRow(out, "APE rotation deg", inDegrees(absolute.rotation));
  appendRow(out, "RPE translation m", relative.translation);
  appendRow(out, "RPE rotation deg", inDegrees(relative.rotation));
  return out.str();
}

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
    throw pcrb::InvalidFile(
        path, 0, "no VIEWPOINT",
        "the sensor's true pose (the identity needs the header's comment `# VIEWPOINT is "
        "the sensor's pose`)");
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
