#include "pcrb_core/datasets/cloud_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "datasets/records.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/foreign_data.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb {
namespace {

/// The part behind the last point, in lower case.
std::string endingOf(std::string_view file_name) {
  const std::size_t point = file_name.rfind('.');
  return inSmallLetters(point == std::string_view::npos ? "" : file_name.substr(point));
}

SensorScan scanOfPcd(std::string_view bytes, OriginPoints origin, const std::string& name) {
  // Who converts a file holds a share of the process's budget already, and would wait for itself.
  MemoryBudget own(MemoryBudget::ofProcess().limit());
  PcdReadOptions options;
  options.budget = &own;
  const TimedCloud cloud = parseTimedPcd(bytes.data(), bytes.data() + bytes.size(), name, options);
  SensorScan scan;
  scan.viewpoint = cloud.viewpoint;
  scan.is_viewpoint_known = cloud.is_viewpoint_known;
  scan.notes = cloud.notes;
  scan.points.reserve(cloud.points.size());
  for (std::size_t i = 0; i != cloud.points.size(); ++i) {
    const bool is_kept = scan.add(cloud.points[i], origin);
    if (is_kept && !cloud.times.empty()) scan.times.push_back(cloud.times[i]);
  }
  scan.counts.read += cloud.dropped_non_finite;
  scan.counts.non_finite += cloud.dropped_non_finite;
  return scan;
}

/// Records of another length make numbers that no lidar gives.
void requirePossible(const SensorScan& scan, std::size_t fields, const std::string& name) {
  constexpr double kReach = 1000.0;  // m
  constexpr std::size_t kFew = 10;
  const auto impossible = static_cast<std::size_t>(std::count_if(
      scan.points.begin(), scan.points.end(),
      [](const Eigen::Vector3d& point) { return point.lpNorm<Eigen::Infinity>() > kReach; }));
  const std::size_t wrong = impossible + scan.counts.non_finite;
  if (impossible == 0 || wrong <= std::max(kFew, scan.counts.read / 100)) return;
  throw InvalidFile(name, 0,
                    std::to_string(wrong) + " of " + std::to_string(scan.counts.read) +
                        " records with a coordinate beyond 1 km or that is not finite",
                    "records of " + std::to_string(fields) +
                        " float32 numbers (x y z first): are these longer or shorter? "
                        "(--bin-fields)");
}

/// Whether a number is whole in all records, if they have so many: a ring, a line, an intensity.
bool hasWholeNumber(std::string_view bytes, std::size_t fields) {
  const std::size_t length = fields * sizeof(float);
  for (std::size_t offset = 0; offset != length; offset += sizeof(float)) {
    std::size_t at = offset;
    for (; at < bytes.size(); at += length) {
      const double number = loadNumber(bytes.data() + at, RecordField{}, false);
      if (number != std::floor(number)) break;
    }
    if (at >= bytes.size()) return true;
  }
  return false;
}

/// In records of another length than the real one, all numbers of all columns are mixed.
void requireNoOtherLength(std::string_view bytes, std::size_t fields, const std::string& name) {
  constexpr std::size_t kFewBytes = 1000;
  if (bytes.size() < kFewBytes || hasWholeNumber(bytes, fields)) return;
  for (std::size_t other = 3; other <= 8; ++other) {
    if (bytes.size() % (other * sizeof(float)) != 0 || !hasWholeNumber(bytes, other)) continue;
    throw InvalidFile(name, 0,
                      "a column of whole numbers, as of rings, if records have " +
                          std::to_string(other) + " float32 numbers, and none if they have " +
                          std::to_string(fields),
                      "records of " + std::to_string(fields) +
                          " numbers (x y z first): try --bin-fields " + std::to_string(other));
  }
}

SensorScan parseBin(std::string_view bytes, const CloudFileOptions& options,
                    const std::string& name) {
  requireData(bytes, name);
  RecordLayout layout;
  layout.length = 4 * options.bin_fields;
  layout.y.offset = 4;
  layout.z.offset = 8;
  if (bytes.empty() || bytes.size() % layout.length != 0) {
    throw InvalidFile(name, 0, std::to_string(bytes.size()) + " bytes",
                      "records of " + std::to_string(layout.length) + " bytes, " +
                          std::to_string(options.bin_fields) + " float32 numbers (--bin-fields)");
  }
  SensorScan scan = readRecords(bytes, bytes.size() / layout.length, layout, options.origin, name);
  requirePossible(scan, options.bin_fields, name);
  requireNoOtherLength(bytes, options.bin_fields, name);
  return scan;
}

}  // namespace

bool isCloudFileName(std::string_view file_name) {
  constexpr std::array<std::string_view, 4> kEndings = {".pcd", ".ply", ".bin", ".npy"};
  return std::count(kEndings.begin(), kEndings.end(), endingOf(file_name)) > 0;
}

std::optional<Stamp> stampOfFileName(std::string_view file_name) {
  constexpr std::size_t kNanosecondDigits = 19;
  const std::string_view stem = file_name.substr(0, file_name.rfind('.'));
  const std::string_view word = stem.substr(stem.rfind('_') + 1);
  if (word.find('.') != std::string_view::npos) return parseStamp(word);
  return word.size() == kNanosecondDigits ? parseInt(word) : std::nullopt;
}

SensorScan parseCloudFile(std::string_view bytes, const std::string& name,
                          const CloudFileOptions& options) {
  const std::string ending = endingOf(name);
  if (ending == ".ply") return parsePly(bytes, options.origin, name);
  if (ending == ".npy") return parseNpy(bytes, options.origin, name);
  if (ending == ".bin") return parseBin(bytes, options, name);
  return scanOfPcd(bytes, options.origin, name);
}

}  // namespace pcrb
