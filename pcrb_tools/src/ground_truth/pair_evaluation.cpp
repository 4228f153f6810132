#include "ground_truth/pair_evaluation.hpp"

#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "pcrb_core/error.hpp"
#include "pcrb_core/evaluation/metric.hpp"
#include "pcrb_core/io/csv.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb_tools {
namespace {

constexpr std::string_view kPublishedHeader = "misalignment_m,tx,ty,tz,qx,qy,qz,qw";
constexpr std::string_view kOwnColumns = ",source,target,reason";
constexpr std::size_t kNumbers = 8;  // columns

void addNames(PairFile& file, const PairNames& pair, const std::string& remark) {
  for (const std::string& field : {pair.source, pair.target, remark}) {
    file.text += ',';
    pcrb::appendCsvField(file.text, field);
  }
  file.text += '\n';
}

void addNumbers(PairFile& file, double misalignment, const Eigen::Vector3d& translation,
                const Eigen::Quaterniond& rotation) {
  file.misalignments.push_back(misalignment);
  file.translations.push_back(translation.norm());
  const double angle = 2.0 * std::atan2(rotation.vec().norm(), std::abs(rotation.w()));
  file.rotations_deg.push_back(angle * 180.0 / M_PI);
}

void readRow(const pcrb::LineReader& lines, const std::vector<std::string>& fields,
             PairFile& file) {
  if (fields.size() < kNumbers) {
    lines.fail(std::to_string(fields.size()) + " fields", "at least 8");
  }
  bool is_empty = true;
  for (std::size_t i = 0; i < kNumbers; ++i) is_empty &= fields[i].empty();
  if (is_empty) {
    ++file.failed;
    return;
  }
  std::array<double, kNumbers> numbers{};
  for (std::size_t i = 0; i < kNumbers; ++i) {
    const auto value = pcrb::parseDouble(fields[i]);
    if (!value || !std::isfinite(*value)) lines.fail(pcrb::inQuotes(fields[i]), "a finite number");
    numbers[i] = *value;
  }
  if (numbers[0] < 0.0) lines.fail(pcrb::inQuotes(fields[0]), "a length in m");
  addNumbers(file, numbers[0], {numbers[1], numbers[2], numbers[3]},
             {numbers[7], numbers[4], numbers[5], numbers[6]});
}

}  // namespace

PairFile emptyPairFile() {
  PairFile file;
  file.text = std::string(kPublishedHeader) + std::string(kOwnColumns) + "\n";
  return file;
}

void addAligned(PairFile& file, const PairNames& pair, double misalignment,
                const pcrb::Transform& moved, const std::string& remark) {
  const Eigen::Quaterniond q(moved.linear());
  const Eigen::Vector3d& t = moved.translation();
  pcrb::appendShortest(file.text, misalignment);
  for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}) {
    file.text += ",";
    pcrb::appendShortest(file.text, value);
  }
  addNames(file, pair, remark);
  addNumbers(file, misalignment, t, q);
}

void addFailed(PairFile& file, const PairNames& pair, const std::string& reason) {
  file.text += std::string(kNumbers - 1, ',');
  addNames(file, pair, reason);
  ++file.failed;
}

std::string_view publishedPairHeader() { return kPublishedHeader; }

PairFile readPairFile(const std::string& path) {
  return parsePairFile(std::string(pcrb::FileBytes(path).text()), path);
}

PairFile parsePairFile(const std::string& text, const std::string& path) {
  PairFile file;
  file.text = text;
  pcrb::LineReader lines(text, path);
  std::string_view line;
  const bool has_header = lines.next(line);
  const std::string own = std::string(kPublishedHeader) + std::string(kOwnColumns);
  if (!has_header || (line != kPublishedHeader && line != own)) {
    throw pcrb::InvalidFile(path, 1, has_header ? pcrb::inQuotes(line) : "nothing",
                            "the header " + std::string(kPublishedHeader));
  }
  std::vector<std::string> fields;
  while (pcrb::nextCsvRow(lines, fields)) readRow(lines, fields, file);
  return file;
}

PairEvaluator::PairEvaluator(std::string folder, double radius, int threads)
    : folder_(std::move(folder)),
      method_(pcrb::makeRegistration("ppcr", {{"voxel_leaf", "0"},
                                              {"sampling_fraction", "1"},
                                              {"neighbors", "10"},
                                              {"search_radius", pcrb::formatShortest(radius)},
                                              {"cut_quantile", "1"},
                                              {"robust", "false"},
                                              {"threads", std::to_string(threads)}})) {}

void PairEvaluator::evaluate(const PairNames& pair, PairFile& file) {
  try {
    setTarget(pair.target);
    align(pair, file);
  } catch (const pcrb::RegistrationFailed& failure) {
    addFailed(file, pair, failure.what());
  } catch (const pcrb::InvalidProblem& error) {
    addFailed(file, pair, error.what());
  }
}

void PairEvaluator::setTarget(const std::string& name) {
  if (name == target_) return;
  target_.clear();
  const pcrb::DatasetCloud cloud = pcrb::readPcd(folder_ + "/" + name);
  local_origin_ = pcrb::chooseLocalOrigin(cloud);
  method_->setTarget(
      std::make_shared<const pcrb::PointCloud>(pcrb::makeLocal(cloud, local_origin_)));
  target_ = name;
}

void PairEvaluator::align(const PairNames& pair, PairFile& file) {
  const pcrb::PointCloud source =
      pcrb::makeLocal(pcrb::readPcd(folder_ + "/" + pair.source), local_origin_);
  const pcrb::Metric metric(source);
  const auto result = method_->align(source, pcrb::Transform::Identity());
  addAligned(file, pair, metric.unnormalized(result.T_target_source),
             pcrb::inLocalFrame(result.T_target_source, metric.centroid()), result.reason);
}

}  // namespace pcrb_tools
