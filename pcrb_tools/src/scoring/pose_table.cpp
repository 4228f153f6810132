#include <cmath>
#include <optional>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"
#include "pcrb_server/message_conversion.hpp"
#include "scoring/recorded_poses.hpp"

namespace pcrb_tools {
namespace {

constexpr const char* kExpected =
    "an id and 12 entries of a matrix, or a timestamp (or id) and tx ty tz qx qy qz qw";

constexpr double kRotationTolerance =
    1e-3;  // the largest |R'R - I|, as quaternions' norms in replies

/// The rows of a matrix as a client would have sent them; nothing where R is no rotation.
std::optional<geometry_msgs::Pose> poseOfMatrix(const std::vector<double>& numbers) {
  const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> rows(numbers.data());
  const Eigen::Matrix3d R = rows.leftCols<3>();
  const double deviation = (R.transpose() * R - Eigen::Matrix3d::Identity()).norm();
  if (!(deviation <= kRotationTolerance) || R.determinant() < 0.0) return std::nullopt;
  pcrb::Transform T = pcrb::Transform::Identity();
  T.linear() = R;
  T.translation() = rows.col(3);
  return pcrb::toMessage(T);
}

geometry_msgs::Pose poseOfTum(const std::vector<double>& n) {
  geometry_msgs::Pose pose;
  pose.position.x = n[0];
  pose.position.y = n[1];
  pose.position.z = n[2];
  pose.orientation.x = n[3];
  pose.orientation.y = n[4];
  pose.orientation.z = n[5];
  pose.orientation.w = n[6];
  return pose;
}

pcrb::OfflineReply emptyReply() {
  pcrb::OfflineReply reply;
  reply.request.status = pcrb_msgs::SubmitPose::Request::POSE;
  reply.request.solver_time = std::nan("");
  return reply;
}

RecordedPose parseRow(const pcrb::LineReader& reader, const std::vector<std::string_view>& fields) {
  std::vector<double> numbers;
  for (std::size_t i = 1; i < fields.size(); ++i) {
    const auto number = pcrb::parseDouble(fields[i]);
    if (!number) reader.fail(pcrb::inQuotes(fields[i]), "a number");
    numbers.push_back(*number);
  }
  RecordedPose pose;
  pose.label = std::string(fields[0]);
  pose.place = reader.name() + ":" + std::to_string(reader.lineNumber());
  pose.reply = emptyReply();
  if (numbers.size() == 7) {
    pose.reply.request.pose.pose = poseOfTum(numbers);
  } else if (const auto of_matrix = poseOfMatrix(numbers)) {
    pose.reply.request.pose.pose = *of_matrix;
  } else {
    pose.reply.defect = "the matrix has no rotation in it";
  }
  return pose;
}

}  // namespace

std::vector<RecordedPose> readPoseTable(const std::string& path) {
  const pcrb::FileBytes bytes(path);
  pcrb::LineReader reader(bytes.text(), path);
  std::vector<RecordedPose> poses;
  std::vector<std::string_view> fields;
  std::string_view line;
  while (reader.next(line)) {
    pcrb::splitAtBlanks(line, fields);
    if (fields.empty() || fields[0].front() == '#') continue;
    if (fields.size() != 13 && fields.size() != 8) {
      reader.fail(std::to_string(fields.size()) + " words", kExpected);
    }
    poses.push_back(parseRow(reader, fields));
  }
  if (poses.empty()) throw pcrb::InvalidFile(path, 0, "no pose", kExpected);
  return poses;
}

pcrb::Trajectory toTrajectory(const std::vector<RecordedPose>& poses, const std::string& path) {
  std::vector<pcrb::StampedPose> stamped;
  for (const RecordedPose& pose : poses) {
    const auto stamp = pose.label.empty() ? pose.stamp : pcrb::parseTimestamp(pose.label);
    if (!stamp) {
      throw pcrb::InvalidFile(pose.place, 0, "`" + pose.label + "`", "a timestamp of a trajectory");
    }
    if (!pose.reply.defect.empty()) throw pcrb::InvalidFile(pose.place, pose.reply.defect);
    try {
      stamped.push_back({*stamp, pcrb::fromMessage(pose.reply.request.pose.pose)});
    } catch (const pcrb::InvalidProblem& error) {
      throw pcrb::InvalidFile(pose.place, error.what());
    }
  }
  if (stamped.empty()) throw pcrb::InvalidFile(path, 0, "no pose", "a trajectory");
  return pcrb::Trajectory(std::move(stamped));
}

}  // namespace pcrb_tools
