#include <algorithm>
#include <map>
#include <set>

#include "pcrb_core/error.hpp"
#include "pcrb_core/evaluation/results_store.hpp"
#include "pcrb_server/message_conversion.hpp"
#include "pcrb_server/playback/playback.hpp"
#include "playback/problem_scene.hpp"
#include "ros/drawing.hpp"
#include "server/scoring.hpp"

namespace pcrb {

namespace {

using RunInfo = std::map<std::string, std::string>;

std::string require(const RunInfo& info, const std::string& key, const std::string& run) {
  const auto found = info.find(key);
  if (found != info.end()) return found->second;
  throw StoreError(run + ": the run table has no `" + key + "`: no run of benchmark_server");
}

std::vector<Result> selectResults(std::vector<Result> results, const RunOptions& options) {
  const auto is_unwanted = [&](const Result& result) {
    return std::none_of(options.sequences.begin(), options.sequences.end(), [&](const auto& word) {
      return namesSequence(word, result.key.data_set, result.key.sequence);
    });
  };
  results.erase(std::remove_if(results.begin(), results.end(), is_unwanted), results.end());
  if (results.empty()) {
    throw StoreError(options.run + ": the run has no result of the sequences that were asked for");
  }
  std::stable_sort(results.begin(), results.end(), [&](const Result& left, const Result& right) {
    if (options.order == RunOptions::Order::kWorst) return left.error > right.error;
    if (options.order == RunOptions::Order::kBest) return left.error < right.error;
    return left.finished < right.finished;
  });
  return results;
}

ServerParameters toParameters(const RunOptions& options, const RunInfo& info,
                              const std::vector<Result>& results) {
  ServerParameters parameters;
  parameters.root = options.root.empty() ? require(info, "root", options.run) : options.root;
  parameters.presentation = presentationFromString(require(info, "presentation", options.run));
  parameters.upright = require(info, "upright", options.run) == "true";
  parameters.map_frame = options.map_frame;
  std::set<std::string> sequences;
  std::set<Kind> kinds;
  for (const Result& result : results) {
    sequences.insert(result.key.data_set + "/" + result.key.sequence);
    kinds.insert(result.key.kind);
  }
  parameters.sequences.assign(sequences.begin(), sequences.end());
  parameters.kinds.assign(kinds.begin(), kinds.end());
  return parameters;
}

/// The problems by their keys; their files must be those that the run used.
std::map<ProblemKey, PlannedProblem> loadProblems(const ServerParameters& parameters,
                                                  const RunInfo& info) {
  RunPlan plan = makeRunPlan(parameters);
  for (const auto& [name, hash] : plan.problem_files) {
    const auto used = info.find("problem_file " + name);
    if (used != info.end() && used->second != hash) {
      throw StoreError(parameters.root + ": " + name + " has changed since the run used it");
    }
  }
  std::map<ProblemKey, PlannedProblem> problems;
  for (PlannedProblem& planned : plan.problems) {
    ProblemKey key = planned.key;
    problems.emplace(std::move(key), std::move(planned));
  }
  return problems;
}

class RunPlayback : public Playback {
 public:
  RunPlayback(const RunOptions& options, const RunInfo& info, const std::vector<Result>& results)
      : info_(info),
        parameters_(toParameters(options, info, results)),
        results_(results),
        problems_(loadProblems(parameters_, info)),
        secret_(Secret::fromHex(parameters_.isLocalization() ? require(info, "secret", options.run)
                                                             : std::string(32, '0'))),
        poser_(parameters_, secret_),
        frames_(options.map_frame) {
    for (const Result& result : results_) plannedOf(result);
  }

  std::size_t size() const override { return results_.size(); }

  Scene next(const ros::Time& stamp) override {
    if (position_ == results_.size()) position_ = 0;
    const Result& result = results_[position_];
    PosedProblem posed = poser_.pose(plannedOf(result));
    requireSame(*posed.target);
    requireSame(*posed.source);
    const Transform T_residual = posed.presentation.residual(scoredPose(posed, result));
    // Both presentations show the source where its guess puts it, in the map's frame.
    posed.presentation = presentForRegistration(posed.P);
    const bool is_new_target = position_ == 0 || shown_ != posed.planned->target_path;
    shown_ = posed.planned->target_path;
    ServerParameters in_map = parameters_;
    in_map.presentation = PresentationKind::kRegistration;
    Scene scene = problemScene(posed, stamp, is_new_target, frames_, in_map);
    scene.title = posed.planned->subject() + ": " + errorText(result);
    scene.clouds.emplace_back(
        topics::kSourceAligned,
        toMessage(posed.source->cloud, T_residual, makeHeader(parameters_.map_frame, stamp)));
    addText(scene, posed, T_residual, errorText(result), parameters_.map_frame);
    ++position_;
    return scene;
  }

 private:
  const PlannedProblem& plannedOf(const Result& result) const {
    const auto found = problems_.find(result.key);
    if (found != problems_.end()) return found->second;
    throw StoreError(parameters_.root + ": has no problem " + result.key.problem_id + " of " +
                     result.key.data_set + "/" + result.key.sequence + ", which the run has");
  }

  void requireSame(const LoadedCloud& cloud) const {
    const auto used = info_.find("cloud " + cloud.name);
    if (used == info_.end() || used->second == cloud.hash) return;
    throw StoreError(parameters_.root + ": " + cloud.name + " has changed since the run used it");
  }

  RunInfo info_;
  ServerParameters parameters_;
  std::vector<Result> results_;
  std::map<ProblemKey, PlannedProblem> problems_;
  Secret secret_;
  ProblemPoser poser_;
  SceneFrames frames_;
  std::string shown_;  ///< path of the target in the last scene
  std::size_t position_ = 0;
};

}  // namespace

std::unique_ptr<Playback> playRun(const RunOptions& options) {
  const ResultsStore store(options.run, ResultsStore::Access::kReadOnly);
  const RunInfo info = store.runInfo();
  return std::make_unique<RunPlayback>(options, info, selectResults(store.results(), options));
}

}  // namespace pcrb
