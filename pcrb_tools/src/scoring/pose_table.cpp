#include <cmath>
#include <optional>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"
#include "scoring/recorded_poses.hpp"

namespace pcrb_tools {
namespace {

constexpr const char* kExpected =
    "an id and 12 entries of a matrix, or a timestamp (or id) and tx ty tz qx qy qz qw";

constexpr double kRotationTolerance =
    1e-3;  // the largest |R'R - I|, as quaternions' norms in replies

/// The rows of a matrix as a client would have submitted them; nothing where R is no rotation.
std::optional<pcrb::Submission> submissionOfMatrix(const std::vector<double>& numbers) {
  const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> rows(numbers.data());
  const Eigen::Matrix3d R = rows.leftCols<3>();
  const double deviation = (R.transpose() * R - Eigen::Matrix3d::Identity()).norm();
  if (!(deviation <= kRotationTolerance) || R.determinant() < 0.0) return std::nullopt;
  pcrb::Submission submission;
  submission.position = rows.col(3);
  submission.orientation = Eigen::Quaterniond(R).normalized();
  return submission;
}

pcrb::Submission submissionOfTum(const std::vector<double>& n) {
  pcrb::Submission submission;
  submission.position = {n[0], n[1], n[2]};
  submission.orientation = Eigen::Quaterniond(n[6], n[3], n[4], n[5]);
  return submission;
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
  if (numbers.size() == 7) {
    pose.reply.submission = submissionOfTum(numbers);
  } else if (const auto of_matrix = submissionOfMatrix(numbers)) {
    pose.reply.submission = *of_matrix;
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
      reader.fail(std::to_string(fields.size()) + " words in " + pcrb::inQuotes(line), kExpected);
    }
    poses.push_back(parseRow(reader, fields));
  }
  if (poses.empty()) throw pcrb::InvalidFile(path, 0, "no pose", kExpected);
  return poses;
}

}  // namespace pcrb_tools
