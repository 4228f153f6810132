#include "pcrb_core/datasets/cloud_file.hpp"

#include <algorithm>
#include <array>

#include "datasets/record_length.hpp"
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
  requireLikelyLength(bytes, options.bin_fields, scan, name);
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
