#include "pcrb_core/datasets/pose_file.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

#include "datasets/log_rows.hpp"
#include "datasets/pose_rows.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"

namespace pcrb {
namespace {

using Numbers = std::vector<double>;

constexpr std::size_t kMatrix = 12;  ///< numbers of the first three rows

/// The rows of one of the formats without names, below each other.
class Rows {
 public:
  Rows(std::string_view text, const std::string& name, PoseFile& file)
      : reader_(text, name), file_(file) {}

  void read() {
    std::string_view line;
    while (reader_.nextDataRow(line)) {
      if (file_.format == PoseFormat::kLog) {
        readBlock(line);
      } else {
        readRow(line, wordsOf(line));
      }
    }
  }

 private:
  void readRow(std::string_view line, const std::vector<std::string_view>& words) {
    FilePose pose;
    if (file_.format == PoseFormat::kTum) {
      require(words.size() == 8, words, line, "timestamp tx ty tz qx qy qz qw");
      const Numbers n = requireFinite(reader_, words, 1, 7, "a number");
      pose.T_world_body =
          requireQuaternionPose(reader_, {n[0], n[1], n[2]}, {n[6], n[3], n[4], n[5]});
    } else if (file_.format == PoseFormat::kEuroc) {
      require(words.size() >= 8, words, line, "timestamp,px,py,pz,qw,qx,qy,qz");
      const Numbers n = requireFinite(reader_, words, 1, 7, "a number");
      pose.T_world_body =
          requireQuaternionPose(reader_, {n[0], n[1], n[2]}, {n[3], n[4], n[5], n[6]});
    } else if (file_.format == PoseFormat::kKaist) {
      require(words.size() == 1 + kMatrix, words, line, "timestamp,r00,r01,r02,tx,…,tz");
      pose.T_world_body =
          requireMatrixPose(reader_, requireFinite(reader_, words, 1, kMatrix, "a number"));
    } else {
      readMatrixRow(line, words, pose);
    }
    if (file_.key == PoseKey::kStamp) pose.stamp = stampOf(words[0]);
    file_.poses.push_back(std::move(pose));
  }

  /// KITTI's 12 numbers, KITTI-360's with an index before them, others' with a timestamp, and all
  /// with a fourth row.
  void readMatrixRow(std::string_view line, const std::vector<std::string_view>& words,
                     FilePose& pose) {
    constexpr std::size_t kFourRows = 16;
    const bool has_index = words.size() == 1 + kMatrix || words.size() == 1 + kFourRows;
    const std::size_t first = has_index ? 1 : 0;
    require(words.size() == first + kMatrix || words.size() == first + kFourRows, words, line,
            "the 12 numbers of a matrix's first three rows");
    pose.T_world_body = requireMatrixPose(
        reader_, requireFinite(reader_, words, first, words.size() - first, "a number"));
    if (has_index && file_.poses.empty() && isTimestamp(words[0])) file_.key = PoseKey::kStamp;
    if (file_.key == PoseKey::kStamp) return;
    const auto index = has_index ? parseUnsigned(words[0]) : file_.poses.size();
    if (!index) reader_.fail(inQuotes(words[0]), "the number of a scan");
    pose.index = *index;
  }

  /// Whether the number before a matrix is no index.
  static bool isTimestamp(std::string_view word) {
    constexpr std::size_t kLongestIndex = 9;  // digits
    return word.size() > kLongestIndex || !parseUnsigned(word);
  }

  /// `i i n` and the matrix below it.
  void readBlock(std::string_view line) {
    const std::string expected = "`i i n`, then the four rows of a 4 x 4 matrix";
    const auto words = wordsOf(line);
    const auto first = words.size() == 3 ? parseUnsigned(words[0]) : std::nullopt;
    if (!first) reader_.fail(quoted(words, line), expected);
    if (words[0] != words[1]) {
      reader_.fail(inQuotes(line) + ", the motion between two scans",
                   "`i i n`: a log of the scans' poses, e.g. a traj.log");
    }
    Numbers numbers;
    for (int row = 0; row < 4; ++row) {
      if (!reader_.nextDataRow(line)) reader_.fail("the end of the file", expected);
      const auto entries = wordsOf(line);
      require(entries.size() == 4, entries, line, expected);
      const Numbers some = requireFinite(reader_, entries, 0, 4, "a number");
      numbers.insert(numbers.end(), some.begin(), some.end());
    }
    FilePose pose;
    pose.index = *first;
    pose.T_world_body = requireMatrixPose(reader_, numbers);
    file_.poses.push_back(std::move(pose));
  }

  void require(bool holds, const std::vector<std::string_view>& words, std::string_view line,
               const std::string& expected) const {
    if (!holds) reader_.fail(quoted(words, line), expected + adviceOnSeparators(line));
  }

  Stamp stampOf(std::string_view word) {
    constexpr double kLeastInSmallUnits = 1e11;  // of 1973 in ms
    if (!unit_) {
      const bool is_integer = word.find_first_not_of("0123456789") == std::string_view::npos;
      if (file_.format == PoseFormat::kEuroc && !is_integer &&
          parseDouble(word).value_or(0.0) < kLeastInSmallUnits) {
        file_.notes.emplace_back(
            "rows with commas were taken as EuRoC's, w first in the quaternions, although the "
            "timestamps are in seconds (--pose-format tum: w last)");
      }
      unit_ = file_.format != PoseFormat::kTum && is_integer ? 1 : unitBySize(word, file_.notes);
    }
    return requireStamp(reader_, word, *unit_);
  }

  LineReader reader_;
  PoseFile& file_;
  std::optional<Stamp> unit_;
};

bool isNumber(std::string_view word) { return parseDouble(word).has_value(); }

PoseFormat formatOfRow(const LineReader& reader, std::string_view line) {
  const auto words = wordsOf(line);
  const bool has_commas = line.find(',') != std::string_view::npos;
  if (!isNumber(words.front())) {
    if (has_commas) return PoseFormat::kCsv;
    reader.fail(quoted(words, line), "a row of numbers (tum, kitti, log) or of names with commas" +
                                         adviceOnSeparators(line));
  }
  if (has_commas) return words.size() == 1 + kMatrix ? PoseFormat::kKaist : PoseFormat::kEuroc;
  switch (words.size()) {
    case 3:
      return PoseFormat::kLog;
    case 8:
      return PoseFormat::kTum;
    case kMatrix:
    case kMatrix + 1:
    case 16:
    case 17:
      return PoseFormat::kKitti;
    default:
      reader.fail(quoted(words, line),
                  "8 (tum), 12 (kitti) or 3 (log) numbers, or commas (euroc, csv)" +
                      adviceOnSeparators(line));
  }
}

/// The format by the names of columns, which may stand in a comment, or else the first row.
PoseFormat findFormat(std::string_view text, const std::string& name) {
  LineReader reader(text, name);
  std::string_view line;
  while (reader.nextRow(line)) {
    line = trimmed(line);
    if (line.front() != '#') return formatOfRow(reader, line);
    if (hasPoseColumns(line)) return PoseFormat::kCsv;
  }
  throw InvalidFile(name, 0, "no pose", "rows of a trajectory (tum, kitti, euroc, log, csv)");
}

/// A robot that drives turns about z; with w first, read as x, it seems to roll.
bool seemsToRoll(const std::vector<FilePose>& poses) {
  constexpr double kSmall = 0.2;
  constexpr double kLarge = 0.5;
  double largest = 0.0;
  for (const FilePose& pose : poses) {
    const Eigen::Quaterniond q(pose.T_world_body.linear());
    if (std::abs(q.y()) > kSmall || std::abs(q.z()) > kSmall) return false;
    largest = std::max(largest, std::abs(q.x()));
  }
  return largest > kLarge;
}

PoseKey keyOf(PoseFormat format) {
  const bool is_indexed = format == PoseFormat::kKitti || format == PoseFormat::kLog;
  return is_indexed ? PoseKey::kIndex : PoseKey::kStamp;
}

}  // namespace

const char* toString(PoseFormat format) {
  constexpr const char* kNames[] = {"tum", "kitti", "euroc", "kaist", "log", "csv"};
  return kNames[static_cast<std::size_t>(format)];
}

std::size_t PoseFile::duplicates() const {
  std::set<std::tuple<Stamp, std::size_t, std::string>> keys;
  for (const FilePose& pose : poses) keys.emplace(pose.stamp, pose.index, pose.name);
  return poses.size() - keys.size();
}

Trajectory PoseFile::trajectory(const std::string& name) const {
  if (key != PoseKey::kStamp) {
    throw InvalidFile(name, 0, std::string("poses without timestamps (") + toString(format) + ")",
                      "timestamps");
  }
  std::vector<StampedPose> stamped;
  stamped.reserve(poses.size());
  for (const FilePose& pose : poses) stamped.push_back({pose.stamp, pose.T_world_body});
  return Trajectory(std::move(stamped));
}

PoseFile parsePoseFile(std::string_view text, const std::string& name,
                       std::optional<PoseFormat> format) {
  PoseFile file;
  file.format = format ? *format : findFormat(text, name);
  file.key = keyOf(file.format);
  if (file.format == PoseFormat::kCsv) {
    readPoseColumns(text, name, file);
  } else {
    Rows(text, name, file).read();
  }
  if (file.poses.empty()) {
    throw InvalidFile(name, 0, "no pose", std::string("rows of ") + toString(file.format));
  }
  if (file.format == PoseFormat::kTum && seemsToRoll(file.poses)) {
    file.notes.emplace_back(
        "all rotations are about x, as of a robot that rolls over: is w first in the quaternions? "
        "(--pose-format euroc: w first)");
  }
  return file;
}

TrajectoryFile parseTrajectory(std::string_view text, const std::string& name,
                               std::optional<PoseFormat> format) {
  const PoseFile file = parsePoseFile(text, name, format);
  return {file.trajectory(name), file.notes};
}

}  // namespace pcrb
