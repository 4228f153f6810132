#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "pcrb_core/io/number.hpp"
#include "simulation/noise.hpp"
#include "simulation/props.hpp"
#include "simulation/sample_logs.hpp"
#include "simulation/scanner.hpp"

namespace pcrb_tools::simulation {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

/// How the files of a sequence are spelled: the archives differ.
struct CsvStyle {
  std::string header;
  std::string separator;
  std::string line_end;
  bool decimals_in_ids;
  bool intensities;  ///< else −1: not recorded
};

struct EthSequence {
  std::string name;
  SceneDescription (*describe)(std::uint64_t);
  std::vector<Vector3d> path;  ///< m; z is the scanner's height above the ground
  double spacing;              ///< m, between scans at most
  double clock;                ///< s, Unix time of the start
  std::string pose_folder;
  CsvStyle global_style;
  CsvStyle local_style;
};

constexpr double kEthInterval = 40.0;  // s, from stop to stop
constexpr int kCoordinateDecimals = 8;

std::vector<EthSequence> ethPlans() {
  std::vector<EthSequence> list;
  list.push_back({"apartment",
                  describeApartment,
                  {{3.6, 3.4, 1.0},
                   {1.6, 3.3, 1.0},
                   {2.2, 1.3, 1.0},
                   {4.0, 2.9, 1.1},
                   {5.65, 3.0, 1.1},
                   {5.7, 4.6, 1.0},
                   {7.2, 4.7, 1.0},
                   {8.0, 4.5, 1.0}},
                  0.45,
                  1322935991.0,
                  "leica",
                  {"Time_in_sec, x, y, z, Intensities, 2DscanId, PointId", ",", "\n", false, false},
                  {"Time_in_sec,x,y,z,Intensities,2DscanId,PointId", ", ", "\n", false, false}});
  std::vector<Vector3d> wood_path;
  for (int x = -3; x <= 16; ++x) wood_path.emplace_back(x, woodPath(x), 1.3);
  list.push_back({"wood_summer",
                  describeWood,
                  wood_path,
                  0.45,
                  1314270030.0,
                  "csv_global",
                  {"Time_in_sec,x,y,z,Intensities,2DscanId,Points", ",", "\n", true, true},
                  {"\"Time_in_sec\",\"x\",\"y\",\"z\",\"Intensities\",\"2DscanId\",\"PointId\"",
                   ",", "\r\n", false, true}});
  return list;
}

/// True pose of the scanner at its i-th stop: on a stand that is never quite level.
pcrb::Transform scannerPose(const EthSequence& sequence, const Scene& scene, int i,
                            const LogOptions& options) {
  pcrb::Random random =
      makeStream(options.seed, sequence.name + " pose", static_cast<std::uint64_t>(i));
  const double arc = stopAt(i, options.size.eth_scans, sequence.path, sequence.spacing);
  const PathPoint stop = followPath(sequence.path, arc);
  const Vector3d ground(0.0, 0.0, scene.groundHeight(stop.position.x(), stop.position.y()));
  pcrb::Transform pose = atPlace(stop.position + ground, stop.heading + 0.3 * drawNormal(random));
  pose.rotate(AngleAxisd(0.06 * drawNormal(random), Vector3d::UnitY()));
  pose.rotate(AngleAxisd(0.06 * drawNormal(random), Vector3d::UnitX()));
  return pose;
}

void appendId(std::string& text, int id, bool decimals) {
  text += std::to_string(id);
  if (decimals) text += ".000000";
}

void appendPoint(std::string& text, const CsvStyle& style, const ScanPoint& point,
                 const Vector3d& position, double clock) {
  pcrb::appendFixed(text, clock + point.time, 6);
  for (int i = 0; i < 3; ++i) {
    text += style.separator;
    pcrb::appendFixed(text, position[i], kCoordinateDecimals);
  }
  text += style.separator;
  text += style.intensities ? std::to_string(std::lround(4000.0 * point.strength)) : "-1";
  text += style.separator;
  appendId(text, point.line, style.decimals_in_ids);
  text += style.separator;
  appendId(text, point.index + 1, style.decimals_in_ids);
  text += style.line_end;
}

void makeEthScan(const EthSequence& sequence, const LazyScene& scene, const LogOptions& options,
                 int i, const std::string& output, const std::vector<std::string>& files) {
  const pcrb::Transform truth = scannerPose(sequence, scene.get(), i, options);
  const double start = kEthInterval * i;
  pcrb::Random random = makeStream(options.seed, sequence.name, static_cast<std::uint64_t>(i));
  const auto points =
      takeScan(scene.get(), makeTiltingHokuyo(options.size.eth_lines, options.size.eth_beams),
               standAt(truth), start, random);
  const Vector3d error = PoseError(options.seed, options.ground_truth_error).at(start);
  const pcrb::Transform T_world_scanner = displaced(truth, error);
  std::string global = sequence.global_style.header + sequence.global_style.line_end;
  std::string local = sequence.local_style.header + sequence.local_style.line_end;
  for (const ScanPoint& point : points) {
    if (point.position.isZero()) continue;
    appendPoint(global, sequence.global_style, point, T_world_scanner * point.position,
                sequence.clock);
    appendPoint(local, sequence.local_style, point, point.position, sequence.clock);
  }
  writeLogFile(output, files.at(0), global);
  writeLogFile(output, files.at(1), local);
}

void makePoses(const EthSequence& sequence, const LazyScene& scene, const LogOptions& options,
               const std::string& output, const std::string& file) {
  std::string text =
      "poseId, timestamp, T00, T01, T02, T03, T10, T11, T12, T13, T20, T21, T22, T23, T30, T31, "
      "T32, T33\n";
  const PoseError pose_error(options.seed, options.ground_truth_error);
  for (int i = 0; i < options.size.eth_scans; ++i) {
    const double start = kEthInterval * i;
    const pcrb::Transform pose =
        displaced(scannerPose(sequence, scene.get(), i, options), pose_error.at(start));
    text += std::to_string(i) + ", " + pcrb::formatFixed(sequence.clock + start, 6);
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 4; ++column) {
        text += ", ";
        pcrb::appendShortest(text, pose.matrix()(row, column));
      }
    }
    text += "\n";
  }
  writeLogFile(output, file, text);
}

std::string numbered(const std::string& name, int number, const std::string& suffix) {
  return name + std::to_string(number) + suffix;
}

void planSequence(const EthSequence& sequence, const LogOptions& options, LogPlan& plan) {
  const LazyScene scene = lazyScene(sequence.describe, options.seed);
  const std::string folder = "eth/" + sequence.name + "/";
  const PoseError pose_error(options.seed, options.ground_truth_error);
  for (int i = 0; i < options.size.eth_scans; ++i) {
    const std::vector<std::string> files{folder + "csv_global/" + numbered("PointCloud", i, ".csv"),
                                         folder + "csv_local/" + numbered("Hokuyo_", i, ".csv")};
    plan.jobs.push_back({files, [=](const std::string& output) {
                           makeEthScan(sequence, scene, options, i, output, files);
                         }});
    plan.errors.push_back(
        {"eth", sequence.name, numbered("PointCloud", i, ".pcd"), pose_error.at(kEthInterval * i)});
  }
  const std::string poses = folder + sequence.pose_folder + "/pose_scanner_leica.csv";
  plan.jobs.push_back({{poses}, [=](const std::string& output) {
                         makePoses(sequence, scene, options, output, poses);
                       }});
}

}  // namespace

LogPlan planEthLogs(const LogOptions& options) {
  LogPlan plan;
  for (const EthSequence& sequence : ethPlans()) planSequence(sequence, options, plan);
  return plan;
}

}  // namespace pcrb_tools::simulation
