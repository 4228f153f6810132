#include "report/problem_details.hpp"

#include <cmath>

#include "pcrb_core/error.hpp"
#include "pcrb_core/evaluation/metric.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/parallel.hpp"
#include "pcrb_core/problem/presentation.hpp"
#include "pcrb_core/problem/problem.hpp"
#include "pcrb_core/problem/secret.hpp"

namespace pcrb_tools {
namespace {

using pcrb::Transform;

std::string nameOf(const pcrb::ProblemKey& key) {
  return key.data_set + "/" + key.sequence + ", " + pcrb::toString(key.kind) + " problem " +
         key.problem_id;
}

std::string infoOf(const Entry& entry, const std::string& key) {
  const auto found = entry.info.find(key);
  return found == entry.info.end() ? std::string() : found->second;
}

/// What the run store has of a pose error, from which this one was found anew, must be the same.
void requireSameError(const ScoredProblem& problem, const Transform& residual,
                      const pcrb::PoseComponents& components) {
  constexpr double kTolerance = 1e-3;  // m and rad: far above rounding, far below another cloud's
  const double angle = pcrb::rotationAngle(residual.linear());
  const double length = components.translation.norm();
  if (std::abs(angle - problem.rotation_error.value_or(angle)) <= kTolerance &&
      std::abs(length - problem.translation_error.value_or(length)) <=
          kTolerance * (1.0 + length)) {
    return;
  }
  throw pcrb::InvalidProblem(
      nameOf(problem.key) + ": found an error of " + std::to_string(length) + " m and " +
      std::to_string(angle) + " rad from its clouds, expected the stored " +
      std::to_string(problem.translation_error.value_or(length)) + " m and " +
      std::to_string(problem.rotation_error.value_or(angle)) +
      " rad: the data sets have changed since the run (--no-components leaves them alone)");
}

}  // namespace

ProblemDetails::ProblemDetails(std::string root) : root_(std::move(root)) {
  for (pcrb::SequenceFiles& files : pcrb::findSequences(root_)) {
    const SequenceKey key{{files.data_set, files.sequence}, files.kind};
    sequences_[key].files = std::move(files);
  }
}

ProblemDetails::Sequence& ProblemDetails::sequenceOf(const pcrb::ProblemKey& key) {
  const auto found = sequences_.find({{key.data_set, key.sequence}, key.kind});
  if (found == sequences_.end()) {
    throw pcrb::InvalidFile(root_, "has no problem file of " + nameOf(key));
  }
  Sequence& sequence = found->second;
  if (sequence.problems.empty()) {
    for (auto& problem : pcrb::readProblemFile(sequence.files.problem_file)) {
      const std::string id = problem.id;
      sequence.problems.emplace(id, std::move(problem));
    }
  }
  return sequence;
}

const pcrb::Problem& ProblemDetails::problemOf(const pcrb::ProblemKey& key) {
  const Sequence& sequence = sequenceOf(key);
  const auto found = sequence.problems.find(key.problem_id);
  if (found == sequence.problems.end()) {
    throw pcrb::InvalidFile(sequence.files.problem_file, "has no problem " + key.problem_id);
  }
  return found->second;
}

std::vector<double> ProblemDetails::overlapsOf(const std::string& data_set,
                                               const std::string& sequence, pcrb::Kind kind) {
  if (sequences_.count({{data_set, sequence}, kind}) == 0) return {};
  std::map<std::pair<std::string, std::string>, double> pairs;
  for (const auto& [id, problem] : sequenceOf({data_set, sequence, kind, ""}).problems) {
    pairs.emplace(std::pair(problem.source, problem.target), problem.overlap);
  }
  std::vector<double> overlaps;
  for (const auto& [pair, overlap] : pairs) overlaps.push_back(overlap);
  return overlaps;
}

void ProblemDetails::addPairs(Entry& entry) {
  for (ScoredProblem& problem : entry.problems) {
    if (!problem.source.empty()) continue;
    const pcrb::Problem& known = problemOf(problem.key);
    problem.source = known.source;
    problem.target = known.target;
    if (!problem.overlap) problem.overlap = known.overlap;
    problem.pair = pairOf(problem);
  }
}

const ProblemDetails::Cloud& ProblemDetails::cloud(const std::string& path) {
  const auto known = clouds_.find(path);
  if (known != clouds_.end()) return known->second;
  const pcrb::DatasetCloud read = pcrb::readPcd(path, {pcrb::processorCount()});
  Cloud cloud;
  cloud.origin = pcrb::chooseLocalOrigin(read);
  cloud.centroid = pcrb::centroid(read);
  cloud.has_viewpoint = read.hasViewpoint();
  cloud.viewpoint = read.viewpoint;
  Transform metre = Transform::Identity();
  metre.translation().x() = 1.0;
  const pcrb::Metric metric(pcrb::makeLocal(read, cloud.origin));
  cloud.error_per_metre = metric.evaluate(metre).error;
  return clouds_.emplace(path, cloud).first->second;
}

void ProblemDetails::addErrorPerMetre(ScoredProblem& problem) {
  const std::string& source = problemOf(problem.key).source;
  const std::string folder = sequenceOf(problem.key).files.cloud_folder + "/";
  problem.error_per_metre = cloud(folder + source).error_per_metre;
}

void ProblemDetails::addComponents(const Entry& entry, ScoredProblem& problem) {
  if (!problem.reply) return;
  const pcrb::Problem& known = problemOf(problem.key);
  const std::string folder = sequenceOf(problem.key).files.cloud_folder + "/";
  const Eigen::Vector3d origin = cloud(folder + known.target).origin;
  const Cloud& source = cloud(folder + known.source);
  const Eigen::Vector3d centroid = source.centroid - origin;
  const Transform P = pcrb::inLocalFrame(pcrb::requireRigid(known.perturbation), origin);
  pcrb::Presentation presentation = pcrb::presentForRegistration(P);
  if (infoOf(entry, "presentation") == "localization") {
    Transform viewpoint = source.viewpoint;
    viewpoint.translation() -= origin;
    const std::string subject = problem.key.data_set + "/" + problem.key.sequence + " " +
                                pcrb::toString(problem.key.kind) + " " + problem.key.problem_id;
    const Transform V = pcrb::secretSensorPose(pcrb::Secret::fromHex(infoOf(entry, "secret")),
                                               subject, source.has_viewpoint, viewpoint, centroid,
                                               infoOf(entry, "upright") == "true");
    presentation = pcrb::presentForLocalization(P, V);
  }
  const Transform residual = presentation.residual(*problem.reply);
  const pcrb::PoseComponents components = pcrb::poseComponents(residual, centroid);
  requireSameError(problem, residual, components);
  problem.components = components.values();
}

void ProblemDetails::addComponents(Entry& entry, Progress& progress) {
  for (ScoredProblem& problem : entry.problems) {
    addComponents(entry, problem);
    progress.add();
  }
}

}  // namespace pcrb_tools
