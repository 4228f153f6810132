#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "datasets/named_columns.hpp"
#include "datasets/pose_rows.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"
#include "pcrb_core/transform.hpp"

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
  if (startsWith(text, start)) text = std::string(by) + text.substr(start.size());
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
    if (c != '"' && c != '#' && c != '%') column.name += c;
  }
  column.name = inSmallLetters(column.name);
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

std::string poseMeaningOf(const std::string& column) {
  const std::string name = plain(column).name;
  const auto known = synonyms().find(name);
  return known == synonyms().end() ? name : known->second;
}

/// Reads the rows below a row of names.
class ColumnReader {
 public:
  ColumnReader(std::string_view text, const std::string& name, PoseFile& file)
      : columns_(text, name, poseMeaningOf, kExpectedColumns),
        is_matrix_(columns_.hasMatrix("t")),
        file_(file) {
    const bool has_pose = has("x") && has("y") && has("z") && hasRotation();
    if (!has_pose && !is_matrix_) {
      columns_.reader().fail("the columns " + joined(columns_.names()), kExpectedColumns);
    }
    for (const char* angle : {"roll", "pitch", "yaw"}) {
      radians_[angle] = has(angle) && startsWith(unitIn(angle), "deg") ? kRadiansPerDegree : 1.0;
    }
    chooseKey();
  }

  void read() {
    while (columns_.next()) readRow();
  }

 private:
  bool has(const std::string& meaning) const { return columns_.has(meaning); }
  std::string unitIn(const std::string& meaning) const {
    return plain(columns_.nameOf(meaning)).unit;
  }

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
      columns_.reader().fail("no column timestamp, frame or file", kExpectedColumns);
    }
  }

  void readRow() {
    FilePose pose;
    if (file_.key == PoseKey::kStamp) pose.stamp = stamp();
    if (file_.key == PoseKey::kName) pose.name = columns_.field("name");
    if (file_.key == PoseKey::kIndex) {
      const auto index = parseUnsigned(columns_.field("index"));
      if (!index) columns_.reader().fail(inQuotes(columns_.field("index")), "the number of a scan");
      pose.index = *index;
    }
    pose.T_world_body = is_matrix_ ? columns_.pose("t") : poseOfRow();
    file_.poses.push_back(std::move(pose));
  }

  double angle(const std::string& meaning) const {
    return columns_.number(meaning) * radians_.at(meaning);
  }

  Transform poseOfRow() const {
    const auto n = [&](const char* meaning) { return columns_.number(meaning); };
    const Eigen::Vector3d translation(n("x"), n("y"), n("z"));
    if (has("qw")) {
      return requireQuaternionPose(columns_.reader(), translation,
                                   {n("qw"), n("qx"), n("qy"), n("qz")});
    }
    using Axis = Eigen::AngleAxisd;
    return makeTransform(translation, Axis(angle("yaw"), Eigen::Vector3d::UnitZ()) *
                                          Axis(angle("pitch"), Eigen::Vector3d::UnitY()) *
                                          Axis(angle("roll"), Eigen::Vector3d::UnitX()));
  }

  Stamp stamp() {
    if (!has("stamp")) {
      return requireStamp(columns_.reader(), columns_.field("sec"), kSecond) +
             requireStamp(columns_.reader(), columns_.field("nsec"), 1);
    }
    const std::string& field = columns_.field("stamp");
    if (!unit_) unit_ = unitOf(field);
    return requireStamp(columns_.reader(), field, *unit_);
  }

  Stamp unitOf(const std::string& field) {
    const std::string unit = unitIn("stamp");
    if (unit == "ns") return 1;
    if (unit == "us") return 1'000;
    if (unit == "ms") return 1'000'000;
    return unit == "s" ? kSecond : unitBySize(field, file_.notes);
  }

  NamedColumns columns_;
  bool is_matrix_;
  std::map<std::string, double> radians_;  ///< of a unit of an angle's column
  PoseFile& file_;
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
