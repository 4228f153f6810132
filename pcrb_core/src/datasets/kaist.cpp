#include "pcrb_core/datasets/kaist.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "datasets/log_rows.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/byte_order.hpp"
#include "pcrb_core/io/foreign_data.hpp"
#include "pcrb_core/io/number.hpp"

namespace pcrb {
namespace {

constexpr std::size_t kRecordSize = 16;
constexpr std::size_t kFewImpossible = 10;

/// Whether a lidar on a car can have given a point; points that are not finite count apart.
bool isPossible(const Eigen::Vector3d& point, float intensity) {
  constexpr double kReach = 1000.0;  // m
  return !point.allFinite() || (point.lpNorm<Eigen::Infinity>() <= kReach && !(intensity < 0.0F));
}

/// The numbers after `key` at the start of a line, or none if the line has another key.
///
/// The key is compared up to its colon: `RPY:` begins with R too.
std::vector<double> keyedNumbers(const LineReader& reader, std::string_view line,
                                 std::string_view key, std::size_t count) {
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos || trimmed(line.substr(0, colon)) != key) return {};
  return requireNumbers(reader, line.substr(colon + 1), Separator::kBlanks, count,
                        std::to_string(count) + " numbers after '" + std::string(key) + ":'");
}

void takeOnce(const LineReader& reader, std::vector<double>&& numbers, std::vector<double>& kept) {
  if (numbers.empty()) return;
  if (!kept.empty()) reader.fail("the same key again", "one line of each key");
  kept = std::move(numbers);
}

Eigen::Matrix<double, 3, 4> rowsOf(const double* numbers) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(numbers);
}

}  // namespace

SensorScan parseVelodyneScan(std::string_view bytes, OriginPoints origin, const std::string& name) {
  requireData(bytes, name);
  if (bytes.size() % kRecordSize != 0) {
    throw InvalidFile(name, 0, std::to_string(bytes.size()) + " bytes",
                      "records of 16 bytes (x y z intensity, float32)");
  }
  SensorScan scan;
  scan.points.reserve(bytes.size() / kRecordSize);
  std::size_t impossible = 0;
  for (std::size_t at = 0; at != bytes.size(); at += kRecordSize) {
    const char* const record = bytes.data() + at;
    const Eigen::Vector3d point(loadFloat<float>(record), loadFloat<float>(record + 4),
                                loadFloat<float>(record + 8));
    impossible += isPossible(point, loadFloat<float>(record + 12)) ? 0 : 1;
    scan.add(point, origin);
  }
  const std::size_t records = bytes.size() / kRecordSize;
  if (impossible > std::max(kFewImpossible, records / 100)) {
    throw InvalidFile(
        name, 0,
        std::to_string(impossible) + " of " + std::to_string(records) +
            " records with a coordinate beyond 1 km or a negative intensity",
        "records of 16 bytes (x y z intensity, float32): are these longer or shorter?");
  }
  return scan;
}

std::vector<Stamp> parseKaistStamps(std::string_view text, const std::string& name) {
  std::vector<Stamp> stamps;
  LineReader reader(text, name);
  std::string_view line;
  while (reader.nextRow(line)) {
    const auto stamp = parseInt(trimmed(line));
    if (!stamp || *stamp < 0) reader.fail(inQuotes(line), "a stamp in ns");
    stamps.push_back(*stamp);
  }
  return stamps;
}

Transform parseKaistCalibration(std::string_view text, const std::string& name) {
  std::vector<double> rotation;
  std::vector<double> translation;
  Transform T_vehicle_sensor = Transform::Identity();
  LineReader reader(text, name);
  std::string_view line;
  while (reader.next(line)) {
    takeOnce(reader, keyedNumbers(reader, line, "T", 3), translation);
    auto R = keyedNumbers(reader, line, "R", 9);
    if (R.empty()) continue;
    Eigen::Matrix<double, 3, 4> rows = Eigen::Matrix<double, 3, 4>::Zero();
    rows.leftCols<3>() = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(R.data());
    T_vehicle_sensor = requireLogPose(reader, rows);
    takeOnce(reader, std::move(R), rotation);
  }
  if (rotation.empty() || translation.empty()) {
    throw InvalidFile(name, 0, rotation.empty() ? "no line 'R:'" : "no line 'T:'",
                      "lines 'R:' and 'T:'");
  }
  T_vehicle_sensor.translation() = Eigen::Map<const Eigen::Vector3d>(translation.data());
  return T_vehicle_sensor;
}

Trajectory parseKaistTrajectory(std::string_view text, const std::string& name) {
  const std::string expected = "a stamp in ns and 12 numbers, separated by commas";
  std::vector<StampedPose> poses;
  LineReader reader(text, name);
  std::string_view line;
  while (reader.nextRow(line)) {
    const std::size_t comma = line.find(',');
    const auto stamp = parseInt(trimmed(line.substr(0, comma)));
    if (!stamp || *stamp < 0 || comma == std::string_view::npos)
      reader.fail(inQuotes(line), expected);
    const auto numbers =
        requireNumbers(reader, line.substr(comma + 1), Separator::kComma, 12, expected);
    poses.push_back({*stamp, requireLogPose(reader, rowsOf(numbers.data()))});
  }
  if (poses.empty()) throw InvalidFile(name, 0, "no pose", expected);
  return Trajectory(std::move(poses));
}

Stamp closestStamp(const std::vector<Stamp>& stamps, Stamp stamp) {
  const auto next = std::lower_bound(stamps.begin(), stamps.end(), stamp);
  if (next == stamps.begin()) return *next;
  const auto previous = next - 1;
  if (next == stamps.end()) return *previous;
  return stamp - *previous <= *next - stamp ? *previous : *next;
}

PoseLookup kaistPose(const Trajectory& trajectory, Stamp stamp, const KaistOptions& options) {
  PoseLookup answer = options.interpolate ? trajectory.interpolate(stamp, options.max_pose_gap)
                                          : trajectory.nearest(stamp, options.max_pose_gap);
  answer.T_world_body.translation() += options.frame_offset;
  return answer;
}

DatasetCloud mergeScans(PlacedScan left, PlacedScan right) {
  DatasetCloud cloud =
      placeScan(std::move(left.scan), left.T_world_vehicle * left.T_vehicle_sensor);
  movePoints(right.T_world_vehicle * right.T_vehicle_sensor, right.scan.points);
  cloud.points.insert(cloud.points.end(), right.scan.points.begin(), right.scan.points.end());
  cloud.dropped_non_finite += right.scan.counts.non_finite;
  return cloud;
}

std::string kaistSequenceName(std::string_view file_name) {
  constexpr std::string_view kPrefix = "urban";
  if (file_name.substr(0, kPrefix.size()) != kPrefix) return {};
  const std::size_t end =
      std::min(file_name.find_first_not_of("0123456789", kPrefix.size()), file_name.size());
  return end == kPrefix.size() ? std::string() : std::string(file_name.substr(0, end));
}

std::string kaistCloudName(const std::string& sequence, Stamp left_stamp) {
  return sequence + '_' + std::to_string(left_stamp) + ".pcd";
}

}  // namespace pcrb
