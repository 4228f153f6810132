#include "pcrb_core/io/pcd.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <initializer_list>
#include <mutex>
#include <string_view>
#include <system_error>

#include "pcd_header.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb {
namespace {

void appendValues(std::string& text, std::initializer_list<double> values) {
  char separator = 0;
  for (const double value : values) {
    if (separator != 0) text += separator;
    appendShortest(text, value);
    separator = ' ';
  }
  text += '\n';
}

std::string formatHeader(const DatasetCloud& cloud) {
  const std::string points = std::to_string(cloud.points.size());
  // Only where the value would not tell: other files stay byte by byte what they were.
  const bool is_identity = cloud.viewpoint.isApprox(Transform::Identity(), 0.0);
  std::string text = "# .PCD v0.7 - Point Cloud Data file format\n";
  if (cloud.is_viewpoint_known && is_identity) text += kViewpointComment + std::string("\n");
  text +=
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
      "WIDTH " +
      points + "\nHEIGHT 1\nVIEWPOINT ";
  const Eigen::Vector3d t = cloud.viewpoint.translation();
  const Eigen::Quaterniond q(cloud.viewpoint.linear());
  appendValues(text, {t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z()});
  return text + "POINTS " + points + "\nDATA ascii\n";
}

}  // namespace

MemoryBudget::Share takeMemory(const LineReader& lines, std::size_t needed,
                               const PcdReading& options) {
  MemoryBudget& budget = *options.budget;
  if (needed <= budget.limit()) {
    auto share = budget.take(needed);
    if (options.turn != nullptr) options.turn->unlock();
    return share;
  }
  const auto [found, expected] = describeExcess("a cloud", needed, budget.limit());
  lines.fail(found, expected);
}

namespace {

TimedCloud readAll(std::string_view text, const std::string& name, const PcdReading& options,
                   bool with_times) {
  if (options.threads < 1) {
    throw InvalidParameter("threads: found " + std::to_string(options.threads) +
                           ", expected at least 1");
  }
  LineReader lines(text, name);
  const PcdHeader header = readPcdHeader(lines, with_times);
  TimedCloud cloud;
  cloud.viewpoint = header.viewpoint;
  cloud.is_viewpoint_known = header.is_viewpoint_known;
  cloud.notes = header.notes;
  switch (header.data) {
    case PcdData::kAscii:
      readPcdAscii(header, lines, options, cloud);
      break;
    case PcdData::kBinary:
      readPcdBinary(header, lines, options, cloud);
      break;
    case PcdData::kBinaryCompressed:
      readPcdCompressed(header, lines, options, cloud);
      break;
  }
  return cloud;
}

}  // namespace

DatasetCloud readPcd(const std::string& path, const PcdReadOptions& options) {
  static std::mutex one_at_a_time;
  std::unique_lock<std::mutex> turn(one_at_a_time);
  const FileBytes file(path);
  return readAll({file.begin(), file.size()}, path, {options, &turn}, false);
}

DatasetCloud parsePcd(const char* begin, const char* end, const std::string& name,
                      const PcdReadOptions& options) {
  return readAll({begin, static_cast<std::size_t>(end - begin)}, name, {options}, false);
}

TimedCloud parseTimedPcd(const char* begin, const char* end, const std::string& name,
                         const PcdReadOptions& options) {
  return readAll({begin, static_cast<std::size_t>(end - begin)}, name, {options}, true);
}

double pointTimeScale(std::string_view field, bool is_float) {
  constexpr std::array<std::string_view, 7> kNames = {
      "time", "t", "timestamp", "time_stamp", "offset_time", "time_offset", "point_time"};
  constexpr double kNanosecond = 1e-9;  // s
  if (std::count(kNames.begin(), kNames.end(), field) == 0) return 0.0;
  return is_float ? 1.0 : kNanosecond;
}

namespace {

std::string readHeader(const std::string& path) {
  constexpr std::size_t kLongestHeader = 1 << 16;  // bytes
  if (auto start = startOfFile(path, kLongestHeader)) return *std::move(start);
  throw InvalidFile(path, "cannot be read");
}

}  // namespace

std::size_t memoryOfPackedPcd(std::string_view start) {
  std::array<std::uint32_t, 2> sizes{};  // packed, unpacked
  try {
    LineReader lines(start, "");
    const PcdHeader header = readPcdHeader(lines, true);
    if (header.data != PcdData::kBinaryCompressed || lines.rest().size() < sizeof(sizes)) return 0;
    std::memcpy(sizes.data(), lines.rest().data(), sizeof(sizes));
    const std::size_t unpacked = sizes[1];
    return unpacked + 2 * pointBytes(header, std::min(header.points, unpacked));
  } catch (const InvalidFile&) {
    return 0;
  }
}

std::size_t memoryOfPackedPcdFile(const std::string& path) {
  try {
    return memoryOfPackedPcd(readHeader(path));
  } catch (const InvalidFile&) {
    return 0;
  }
}

std::optional<Transform> readViewpoint(const std::string& path) {
  const std::string start = readHeader(path);
  LineReader lines(start, path);
  const PcdHeader header = readPcdHeader(lines, false);
  DatasetCloud cloud;
  cloud.viewpoint = header.viewpoint;
  cloud.is_viewpoint_known = header.is_viewpoint_known;
  return cloud.hasViewpoint() ? std::optional(cloud.viewpoint) : std::nullopt;
}

void writePcd(const std::string& path, const DatasetCloud& cloud) {
  AtomicFile file(path);
  writePcd(file, path, cloud);
  file.commit();
}

void writePcd(AtomicFile& file, const std::string& path, const DatasetCloud& cloud) {
  file.write(formatHeader(cloud));
  std::array<char, 3 * (kLongestNumber + 1)> row;
  for (const Eigen::Vector3d& point : cloud.points) {
    if (!point.allFinite()) {
      throw InvalidFile(path, "cannot write a point that is not finite");
    }
    char* end = row.data();
    for (int axis = 0; axis < 3; ++axis) {
      end = writeShortest(end, point[axis]);
      *end++ = axis < 2 ? ' ' : '\n';
    }
    file.write({row.data(), static_cast<std::size_t>(end - row.data())});
  }
}

namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// The run of digits, or the one other character, at the start of a text that is not empty.
std::string_view nextPart(std::string_view text) {
  std::size_t length = 1;
  while (isDigit(text[0]) && length < text.size() && isDigit(text[length])) ++length;
  return text.substr(0, length);
}

std::string_view withoutZeros(std::string_view digits) {
  return digits.substr(std::min(digits.find_first_not_of('0'), digits.size()));
}

int compareParts(std::string_view left, std::string_view right) {
  if (!isDigit(left[0]) || !isDigit(right[0])) return left.compare(right);
  const std::string_view a = withoutZeros(left);
  const std::string_view b = withoutZeros(right);
  if (a.size() != b.size()) return a.size() < b.size() ? -1 : 1;
  return a.compare(b);
}

}  // namespace

bool naturalLess(const std::string& left, const std::string& right) {
  std::string_view a = left;
  std::string_view b = right;
  while (!a.empty() && !b.empty()) {
    const std::string_view part_a = nextPart(a);
    const std::string_view part_b = nextPart(b);
    const int order = compareParts(part_a, part_b);
    if (order != 0) return order < 0;
    a.remove_prefix(part_a.size());
    b.remove_prefix(part_b.size());
  }
  if (a.empty() != b.empty()) return a.empty();
  return left < right;
}

std::vector<std::string> findClouds(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::filesystem::path& path = entry->path();
    const std::string name = path.filename().string();
    if (path.extension() == ".pcd" && name.front() != '.') names.push_back(name);
  }
  if (error) throw InvalidFile(folder, "cannot list the folder: " + error.message());
  std::sort(names.begin(), names.end(), naturalLess);
  return names;
}

}  // namespace pcrb
