#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>

#include "datasets/pose_rows.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"

namespace pcrb {
namespace {

constexpr const char* kExpectedColumns =
    "columns timestamp (or frame, or file), x y z, and qx qy qz qw, roll pitch yaw or T00 … T23";

/// A column's name, made plain: `field.pose.pose.orientation.x` becomes `qx`, ` p_RS_R_x [m]`
/// becomes `x`.
struct PlainName {
  std::string name;
  std::string unit;
};

void replaceStart(std::string& text, std::string_view start, std::string_view by) {
  if (text.compare(0, start.size(), start) == 0) text = std::string(by) + text.substr(start.size());
}

/// The last parts of a message's path, as the short name that they stand for.
std::string withoutPath(const std::string& name) {
  const std::size_t last = name.find_last_of("./");
  if (last == std::string::npos) return name;
  const std::string leaf = name.substr(last + 1);
  const auto isIn = [&](std::string_view part) {
    return last >= part.size() && name.compare(last - part.size(), part.size(), part) == 0;
  };
  return (isIn("orientation") || isIn("rotation") ? "q" : "") + leaf;
}

PlainName plain(std::string_view field) {
  PlainName column;
  for (const char c : trimmed(field)) {
    if (c != '"' && c != '#' && c != '%') {
      column.name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
  }
  const std::size_t bracket = column.name.find_first_of("[(");
  if (bracket != std::string::npos) {
    column.unit =
        column.name.substr(bracket + 1, column.name.find_first_of("])", bracket) - bracket - 1);
    column.name.resize(bracket);
  }
  column.name = withoutPath(std::string(trimmed(column.name)));
  for (const std::string unit : {"deg", "rad", "ns", "us", "ms", "s", "m"}) {
    const std::size_t end = column.name.size() - std::min(column.name.size(), unit.size() + 1);
    if (column.name.size() > unit.size() + 1 && column.name.substr(end) == "_" + unit) {
      column.unit = unit;
      column.name.resize(end);
    }
  }
  for (const char* start : {"p_rs_r_", "position_", "translation_", "pos_", "p_", "t_"}) {
    replaceStart(column.name, start, "");
  }
  for (const char* start : {"q_rs_", "orientation_", "rotation_", "rot_", "quat_", "q_"}) {
    replaceStart(column.name, start, "q");
  }
  return column;
}

/// The column of each meaning.
using ColumnPlaces = std::map<std::string, std::size_t>;

const std::map<std::string, std::string>& synonyms() {
  static const std::map<std::string, std::string> kSynonyms{{"time", "stamp"},
                                                            {"timestamp", "stamp"},
                                                            {"stamp", "stamp"},
                                                            {"t", "stamp"},
                                                            {"secs", "sec"},
                                                            {"sec", "sec"},
                                                            {"nsecs", "nsec"},
                                                            {"nsec", "nsec"},
                                                            {"nanosec", "nsec"},
                                                            {"frame", "index"},
                                                            {"index", "index"},
                                                            {"frame_id", "index"},
                                                            {"frame_idx", "index"},
                                                            {"idx", "index"},
                                                            {"poseid", "index"},
                                                            {"id", "index"},
                                                            {"file", "name"},
                                                            {"filename", "name"},
                                                            {"name", "name"},
                                                            {"cloud", "name"},
                                                            {"scan", "name"},
                                                            {"tx", "x"},
                                                            {"ty", "y"},
                                                            {"tz", "z"},
                                                            {"px", "x"},
                                                            {"py", "y"},
                                                            {"pz", "z"}};
  return kSynonyms;
}

/// Reads the rows below a row of names.
class ColumnReader {
 public:
  ColumnReader(std::string_view text, const std::string& name, PoseFile& file)
      : reader_(text, name), file_(file) {}

  void read() {
    readNames();
    std::vector<std::string> fields;
    while (nextCsvRow(reader_, fields)) {
      if (fields.front().substr(0, 1) == "#") continue;
      if (fields.size() < width_) {
        reader_.fail(
            std::to_string(fields.size()) + " fields, the first is " + inQuotes(fields.front()),
            std::to_string(width_) + " as in the row of names");
      }
      readRow(fields);
    }
  }

 private:
  void readNames() {
    std::vector<std::string> fields;
    do {
      if (!nextCsvRow(reader_, fields))
        throw InvalidFile(reader_.name(), 0, "no names", kExpectedColumns);
    } while (fields.size() == 1);  // a comment
    width_ = fields.size();
    for (std::size_t i = 0; i != width_; ++i) {
      const PlainName column = plain(fields[i]);
      const auto known = synonyms().find(column.name);
      const std::string meaning = known == synonyms().end() ? column.name : known->second;
      if (columns_.emplace(meaning, i).second) units_[meaning] = column.unit;
    }
    if (has("x") && has("y") && has("z") && hasRotation())
      chooseKey();
    else if (has("t00") && has("t23"))
      chooseKey();
    else
      reader_.fail("the columns " + joined(fields), kExpectedColumns);
  }

  bool has(const std::string& meaning) const { return columns_.count(meaning) > 0; }

  bool hasRotation() const {
    return (has("qx") && has("qy") && has("qz") && has("qw")) ||
           (has("roll") && has("pitch") && has("yaw"));
  }

  void chooseKey() {
    if (has("stamp") || (has("sec") && has("nsec"))) {
      file_.key = PoseKey::kStamp;
    } else if (has("name")) {
      file_.key = PoseKey::kName;
    } else if (has("index")) {
      file_.key = PoseKey::kIndex;
    } else {
      reader_.fail("no column timestamp, frame or file", kExpectedColumns);
    }
  }

  void readRow(const std::vector<std::string>& fields) {
    FilePose pose;
    if (file_.key == PoseKey::kStamp) pose.stamp = stampOf(fields);
    if (file_.key == PoseKey::kName) pose.name = fields[columns_.at("name")];
    if (file_.key == PoseKey::kIndex) {
      const auto index = parseUnsigned(fields[columns_.at("index")]);
      if (!index) reader_.fail(inQuotes(fields[columns_.at("index")]), "the number of a scan");
      pose.index = *index;
    }
    pose.T_world_body = poseOf(fields);
    file_.poses.push_back(std::move(pose));
  }

  double number(const std::vector<std::string>& fields, const std::string& meaning) const {
    const std::string& field = fields[columns_.at(meaning)];
    const auto value = parseDouble(field);
    if (!value || !std::isfinite(*value)) {
      reader_.fail(inQuotes(field) + " in column " + meaning, "a number");
    }
    return *value;
  }

  double angle(const std::vector<std::string>& fields, const std::string& meaning) const {
    constexpr double kDegree = 0.017453292519943295;  // rad
    const bool is_deg = units_.at(meaning).substr(0, 3) == "deg";
    return number(fields, meaning) * (is_deg ? kDegree : 1.0);
  }

  Transform poseOf(const std::vector<std::string>& fields) const {
    const auto n = [&](const std::string& meaning) { return number(fields, meaning); };
    if (has("t00")) {
      std::vector<double> entries;
      for (const char row : {'0', '1', '2'}) {
        for (const char column : {'0', '1', '2', '3'}) entries.push_back(n({'t', row, column}));
      }
      return requireMatrixPose(reader_, entries);
    }
    const Eigen::Vector3d translation(n("x"), n("y"), n("z"));
    if (has("qw"))
      return requireQuaternionPose(reader_, translation, {n("qw"), n("qx"), n("qy"), n("qz")});
    using Axis = Eigen::AngleAxisd;
    return makeTransform(translation, Axis(angle(fields, "yaw"), Eigen::Vector3d::UnitZ()) *
                                          Axis(angle(fields, "pitch"), Eigen::Vector3d::UnitY()) *
                                          Axis(angle(fields, "roll"), Eigen::Vector3d::UnitX()));
  }

  Stamp stampOf(const std::vector<std::string>& fields) {
    if (!has("stamp")) {
      return requireStamp(reader_, fields[columns_.at("sec")], kSecond) +
             requireStamp(reader_, fields[columns_.at("nsec")], 1);
    }
    const std::string& field = fields[columns_.at("stamp")];
    if (!unit_) unit_ = unitOf(field);
    return requireStamp(reader_, field, *unit_);
  }

  Stamp unitOf(const std::string& field) {
    const std::string& unit = units_.at("stamp");
    if (unit == "ns") return 1;
    if (unit == "us") return 1'000;
    if (unit == "ms") return 1'000'000;
    return unit == "s" ? kSecond : unitBySize(field, file_.notes);
  }

  LineReader reader_;
  PoseFile& file_;
  ColumnPlaces columns_;
  std::map<std::string, std::string> units_;
  std::size_t width_ = 0;
  std::optional<Stamp> unit_;
};

}  // namespace

bool hasPoseColumns(std::string_view line) {
  std::vector<std::string_view> fields;
  splitAt(',', line, fields);
  return std::any_of(fields.begin(), fields.end(), [](std::string_view field) {
    const std::string name = plain(field).name;
    return name == "qw" || name == "yaw" || name == "t00";
  });
}

void readPoseColumns(std::string_view text, const std::string& name, PoseFile& file) {
  ColumnReader(text, name, file).read();
}

}  // namespace pcrb
