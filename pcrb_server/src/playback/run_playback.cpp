#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "pcrb_core/error.hpp"
#include "pcrb_core/run/results_store.hpp"
#include "pcrb_core/run/run_info.hpp"
#include "pcrb_core/run/run_plan.hpp"
#include "pcrb_core/run/scoring.hpp"
#include "pcrb_server/message_conversion.hpp"
#include "pcrb_server/playback/playback.hpp"
#include "playback/scene_parts.hpp"
#include "ros/drawing.hpp"

namespace pcrb {

namespace {

std::vector<Result> selectResults(std::vector<Result> results, const RunOptions& options) {
  const auto is_unwanted = [&](const Result& result) {
    if (options.kind && result.key.kind != *options.kind) return true;
    if (!options.ids.empty() && !contains(options.ids, result.key.problem_id)) return true;
    return std::none_of(options.sequences.begin(), options.sequences.end(), [&](const auto& word) {
      return namesSequence(word, {result.key.data_set, result.key.sequence});
    });
  };
  results.erase(std::remove_if(results.begin(), results.end(), is_unwanted), results.end());
  if (results.empty()) {
    throw StoreError(options.run +
                     ": the run has no result of the sequences and problems that were asked for");
  }
  std::stable_sort(results.begin(), results.end(), [&](const Result& left, const Result& right) {
    if (options.order == RunOptions::Order::kWorst) return left.error > right.error;
    if (options.order == RunOptions::Order::kBest) return left.error < right.error;
    return left.finished < right.finished;
  });
  return results;
}

/// The problems that the results are of, below the root that was asked for.
ProblemSelection selectionOf(const RunOptions& options, const RunInfo& info,
                             const std::vector<Result>& results) {
  ProblemSelection selection;
  selection.root = options.root.empty() ? info.configuration.selection.root : options.root;
  if (selection.root.empty()) {
    throw StoreError(options.run + ": the run table has no `root`: no run of benchmark_server");
  }
  std::set<std::string> sequences;
  std::set<Kind> kinds;
  for (const Result& result : results) {
    sequences.insert(result.key.data_set + "/" + result.key.sequence);
    kinds.insert(result.key.kind);
  }
  selection.sequences.assign(sequences.begin(), sequences.end());
  selection.kinds.assign(kinds.begin(), kinds.end());
  return selection;
}

/// The problems by their keys; their files must be those that the run used.
std::map<ProblemKey, PlannedProblem> loadProblems(const ProblemSelection& selection,
                                                  const RunInfo& info) {
  const RunPlan plan = makeRunPlan(selection);
  for (const auto& [name, hash] : plan.problem_files) {
    const auto used = info.problem_files.find(name);
    if (used != info.problem_files.end() && used->second != hash) {
      throw StoreError(selection.root + ": " + name + " has changed since the run used it");
    }
  }
  return problemsByKey(plan);
}

Secret requireSecret(const RunInfo& info, const Result& result, const std::string& run) {
  if (const auto secret = info.secretOf(result.key)) return *secret;
  throw StoreError(run + ": the run table has no `secret` of " + result.key.subject() +
                   ": no run of benchmark_server, or one that an earlier version merged of shards: "
                   "merge them again, or show a shard");
}

class RunPlayback : public Playback {
 public:
  RunPlayback(const RunOptions& options, const RunInfo& info, const std::vector<Result>& results)
      : run_(options.run),
        info_(info),
        selection_(selectionOf(options, info, results)),
        results_(results),
        problems_(loadProblems(selection_, info)),
        poser_(selection_.root, {}, Secret()),
        frames_(options.map_frame) {
    for (const Result& result : results_) {
      plannedOf(result);
      requireSecret(info_, result, run_);
    }
  }

  std::size_t size() const override { return results_.size(); }

  Scene next(const ros::Time& stamp) override {
    if (position_ == results_.size()) position_ = 0;
    const Result& result = results_[position_];
    PosedProblem posed = poser_.pose(plannedOf(result));
    requireSame(*posed.target);
    requireSame(*posed.source);
    posed.presentation =
        present(posed, info_.configuration.presentation, requireSecret(info_, result, run_));
    const Transform T_residual = posed.presentation.residual(scoredPose(posed, result));
    // Both presentations show the source where its guess puts it, in the map's frame.
    posed.presentation = presentForRegistration(posed.P);
    const bool is_new_target = position_ == 0 || shown_ != posed.planned->target_path;
    shown_ = posed.planned->target_path;
    Scene scene = problemScene(posed, stamp, is_new_target, frames_.map(), frames_);
    scene.title = posed.planned->subject() + ": " + errorText(result);
    scene.clouds.emplace_back(topics::kSourceAligned, toMessage(posed.source->cloud, T_residual,
                                                                makeHeader(frames_.map(), stamp)));
    scene.clouds.emplace_back(
        topics::kSourceTrue,
        toMessage(posed.source->cloud, Transform::Identity(), makeHeader(frames_.map(), stamp)));
    scene.caption = captionOf(posed) + resultCaption(result);
    addText(scene, posed, T_residual, errorText(result), frames_.map());
    ++position_;
    return scene;
  }

  void seek(std::size_t position) override { position_ = position; }

 private:
  const PlannedProblem& plannedOf(const Result& result) const {
    const auto found = problems_.find(result.key);
    if (found != problems_.end()) return found->second;
    throw StoreError(selection_.root + ": has no problem " + result.key.problem_id + " of " +
                     result.key.data_set + "/" + result.key.sequence + ", which the run has");
  }

  std::string resultCaption(const Result& result) const {
    std::ostringstream text;
    text.precision(3);
    text << "error: " << result.error << "\noutcome: " << toString(result.outcome)
         << "\nmethod: " << info_.configuration.under_test << "\n";
    return text.str();
  }

  void requireSame(const LoadedCloud& cloud) const {
    const auto used = info_.clouds.find(cloud.name);
    if (used == info_.clouds.end() || used->second == cloud.hash) return;
    throw StoreError(selection_.root + ": " + cloud.name + " has changed since the run used it");
  }

  std::string run_;
  RunInfo info_;
  ProblemSelection selection_;
  std::vector<Result> results_;
  std::map<ProblemKey, PlannedProblem> problems_;
  ProblemPoser poser_;
  SceneFrames frames_;
  std::string shown_;  ///< path of the target in the last scene
  std::size_t position_ = 0;
};

}  // namespace

std::unique_ptr<Playback> playRun(const RunOptions& options) {
  const ResultsStore store(options.run, ResultsStore::Access::kReadOnly);
  const RunInfo info = RunInfo::read(store);
  return std::make_unique<RunPlayback>(options, info, selectResults(store.results(), options));
}

}  // namespace pcrb
