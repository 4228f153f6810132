#include "report/problem_details.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "pcrb_core/error.hpp"
#include "pcrb_core/evaluation/metric.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/parallel.hpp"
#include "pcrb_core/problem/overlap_matrix.hpp"
#include "pcrb_core/problem/pair_sampling.hpp"
#include "pcrb_core/problem/presentation.hpp"
#include "pcrb_core/problem/problem.hpp"
#include "pcrb_core/problem/secret.hpp"
#include "pcrb_core/run/run_plan.hpp"

namespace pcrb_tools {
namespace {

using pcrb::Transform;

constexpr std::size_t kDetailsCacheBytes = std::size_t{1} << 30;

std::string nameOf(const pcrb::ProblemKey& key) {
  return key.data_set + "/" + key.sequence + ", " + pcrb::toString(key.kind) + " problem " +
         key.problem_id;
}

Untouched untouchedOf(const pcrb::Presentation& presentation, const Eigen::Vector3d& centroid) {
  const Transform residual = presentation.residual(presentation.guess);
  const pcrb::PoseComponents components = pcrb::poseComponents(residual, centroid);
  return {pcrb::rotationAngle(residual.linear()), components.translation.norm(),
          components.values()};
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

ProblemDetails::ProblemDetails(std::string root)
    : root_(std::move(root)),
      poser_(root_, {}, pcrb::Secret(), {kDetailsCacheBytes, pcrb::processorCount()}) {
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

std::optional<pcrb::Range> ProblemDetails::overlapRangeOf(const std::string& data_set,
                                                          const std::string& sequence,
                                                          pcrb::Kind kind) const {
  const std::string path = root_ + "/" + data_set + "/" + sequence + "_overlap.txt";
  if (!std::filesystem::is_regular_file(path)) return std::nullopt;
  const auto pairs = pcrb::eligiblePairs(pcrb::readOverlapMatrix(path), kind);
  if (pairs.empty()) return std::nullopt;
  pcrb::Range range{pairs.front().overlap, pairs.front().overlap};
  for (const pcrb::CloudPair& pair : pairs) {
    range.min = std::min(range.min, pair.overlap);
    range.max = std::max(range.max, pair.overlap);
  }
  return range;
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

pcrb::PlannedProblem ProblemDetails::plan(const pcrb::ProblemKey& key) {
  const pcrb::Problem& problem = problemOf(key);
  auto& data_set = data_sets_[key.data_set];
  if (!data_set) {
    data_set = std::make_shared<pcrb::Dataset>(pcrb::loadDataset(root_, key.data_set));
  }
  return pcrb::planProblem(sequenceOf(key).files, problem, 0, data_set);
}

void ProblemDetails::addErrorPerMetre(ScoredProblem& problem) {
  const pcrb::PlannedProblem planned = plan(problem.key);
  const auto known = errors_per_metre_.find(planned.source_path);
  if (known != errors_per_metre_.end()) {
    problem.error_per_metre = known->second;
    return;
  }
  Transform metre = Transform::Identity();
  metre.translation().x() = 1.0;
  problem.error_per_metre = poser_.pose(planned).source->metric->evaluate(metre).error;
  errors_per_metre_[planned.source_path] = *problem.error_per_metre;
}

void ProblemDetails::addComponents(const pcrb::RunInfo& info, ScoredProblem& problem) {
  if (!problem.reply) return;
  const auto secret = info.secretOf(problem.key);
  if (!secret) return;  // merged by an earlier version, which kept one alone
  const pcrb::PlannedProblem planned = plan(problem.key);
  const pcrb::PosedProblem posed = poser_.pose(planned);
  const pcrb::Presentation presentation =
      pcrb::present(posed, info.configuration.presentation, *secret);
  const Transform residual = presentation.residual(*problem.reply);
  const pcrb::PoseComponents components =
      pcrb::poseComponents(residual, posed.source->metric->centroid());
  requireSameError(problem, residual, components);
  problem.components = components.values();
  problem.untouched = untouchedOf(presentation, posed.source->metric->centroid());
  if (!problem.covariance) return;
  problem.judged = pcrb::judgeCovariance(
      pcrb::poseErrorVector(*problem.reply, presentation.ideal()), *problem.covariance);
}

void ProblemDetails::addComponents(Entry& entry, Progress& progress) {
  for (ScoredProblem& problem : entry.problems) {
    addComponents(entry.info.value(), problem);
    progress.add();
  }
}

}  // namespace pcrb_tools
