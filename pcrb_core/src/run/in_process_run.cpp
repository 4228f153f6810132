#include "pcrb_core/run/in_process_run.hpp"

#include <set>
#include <utility>

#include "pcrb_core/error.hpp"
#include "pcrb_core/run/problem_poser.hpp"
#include "pcrb_core/run/run_plan.hpp"
#include "pcrb_core/run/run_record.hpp"
#include "pcrb_core/run/summary.hpp"

namespace pcrb {

namespace {

std::vector<float> coordinatesOf(const PointCloud& cloud, const Transform& T) {
  std::vector<float> coordinates(3 * cloud.size());
  constexpr std::size_t kStride = 3 * sizeof(float);
  transformPoints(cloud, T, reinterpret_cast<std::uint8_t*>(coordinates.data()), kStride);
  return coordinates;
}

/// What the server makes of an answer, whose defects it would have rejected.
Reply replyTo(const Submission& submission, double runtime, double time_limit) {
  Reply reply;
  if (runtime > time_limit) {
    reply.reason = "no reply within the time limit";
    return reply;
  }
  if (const auto defect = checkSubmission(submission)) {
    reply.outcome = Outcome::kRejected;
    reply.reason = defect->message;
    reply.rejected = 1;
    return reply;
  }
  reply = makeReply(submission, std::nullopt);
  reply.runtime = runtime;
  return reply;
}

}  // namespace

struct InProcessRun::Impl {
  explicit Impl(const InProcessRunOptions& given)
      : options(given),
        plan(makeRunPlan(given.configuration.selection)),
        record(given.run.empty()
                   ? nullptr
                   : std::make_unique<RunRecord>(given.run, given.configuration, plan)),
        secret(record ? record->secret() : Secret()),
        problems(record ? inServingOrder(plan.problems, secret) : plan.problems),
        poser(given.configuration.selection.root, given.configuration.presentation, secret) {
    poser.checkFrames(problems);
    if (!record) return;
    finished = record->finished();
    record->noteClient(given.client, "");
  }

  ClientProblem clientProblem(const PosedProblem& shown) const {
    const ProblemKey& key = shown.planned->key;
    ClientProblem problem;
    problem.id = key.problem_id;
    problem.data_set = key.data_set;
    problem.sequence = key.sequence;
    problem.kind = key.kind;
    problem.target = coordinatesOf(shown.target->cloud, shown.presentation.target_applied);
    problem.source = coordinatesOf(shown.source->cloud, shown.presentation.applied);
    problem.target_intensity = shown.target->cloud.intensity;
    problem.source_intensity = shown.source->cloud.intensity;
    problem.voxel_leaf = shown.planned->data_set->voxel_leaf;
    problem.has_guess = key.kind == Kind::kLocal || options.configuration.global_guess;
    if (problem.has_guess) problem.guess = shown.presentation.guess;
    return problem;
  }

  InProcessRunOptions options;
  RunPlan plan;
  std::unique_ptr<RunRecord> record;
  Secret secret;
  std::vector<PlannedProblem> problems;
  ProblemPoser poser;
  std::set<ProblemKey> finished;
  std::size_t position = 0;  ///< of the next problem
  std::optional<PosedProblem> posed;
};

InProcessRun::InProcessRun(const InProcessRunOptions& options)
    : impl_(std::make_unique<Impl>(options)) {}

InProcessRun::~InProcessRun() = default;

std::size_t InProcessRun::size() const { return impl_->problems.size(); }

std::size_t InProcessRun::done() const { return impl_->finished.size(); }

std::optional<ClientProblem> InProcessRun::next() {
  Impl& run = *impl_;
  run.posed.reset();
  while (run.position < run.problems.size() &&
         run.finished.count(run.problems[run.position].key) > 0) {
    ++run.position;
  }
  if (run.position == run.problems.size()) return std::nullopt;
  run.posed = run.poser.pose(run.problems[run.position++]);
  if (run.record) {
    for (const auto& cloud : {run.posed->target, run.posed->source}) {
      run.record->noteCloud(cloud->name, cloud->hash);
    }
  }
  return run.clientProblem(*run.posed);
}

Result InProcessRun::score(const Submission& submission, double runtime) const {
  if (!impl_->posed) throw InvalidParameter("found no problem, expected one that was asked for");
  const double time_limit = impl_->options.configuration.time_limit;
  return pcrb::score(*impl_->posed, replyTo(submission, runtime, time_limit));
}

Result InProcessRun::submit(const Submission& submission, double runtime) {
  Impl& run = *impl_;
  const Result result = score(submission, runtime);
  if (run.record) run.record->add(result);
  run.finished.insert(result.key);
  run.posed.reset();
  return result;
}

std::string InProcessRun::finish() {
  if (!impl_->record) return "";
  const std::string summary = formatSummary(summarize(impl_->record->results()));
  impl_->record->writeExports(summary);
  return summary;
}

}  // namespace pcrb
