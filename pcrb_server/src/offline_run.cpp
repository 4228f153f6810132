#include "pcrb_server/offline_run.hpp"

#include <optional>
#include <set>

#include "pcrb_server/message_conversion.hpp"
#include "server/problem_poser.hpp"
#include "server/reply_checks.hpp"
#include "server/run_record.hpp"
#include "server/scoring.hpp"

namespace pcrb {

namespace {

ServerParameters toParameters(const OfflineRunOptions& options) {
  ServerParameters parameters;
  parameters.root = options.root;
  parameters.run = options.run;
  parameters.sequences = {options.sequence};
  parameters.kinds = {options.kind};
  parameters.presentation = options.presentation;
  parameters.upright = options.upright;
  parameters.subset = options.subset;
  parameters.seed = options.seed;
  return parameters;
}

std::optional<Secret> secretOf(const OfflineRunOptions& options) {
  if (options.secret.empty()) return std::nullopt;
  return Secret::fromHex(options.secret);
}

Reply without(Outcome outcome, const std::string& reason) {
  Reply reply;
  reply.outcome = outcome;
  reply.reason = reason;
  reply.rejected = outcome == Outcome::kRejected ? 1 : 0;
  return reply;
}

/// A reply in the clouds' frame, in the map's. For registration it takes coordinates of that frame
/// to coordinates of that frame, for localization those of the scan.
Transform toMapFrame(const Transform& T, const Eigen::Vector3d& local_origin,
                     PresentationKind presentation) {
  if (presentation == PresentationKind::kRegistration) return inLocalFrame(T, local_origin);
  Transform moved = T;
  moved.translation() -= local_origin;
  return moved;
}

}  // namespace

struct OfflineRun::Impl {
  explicit Impl(const OfflineRunOptions& given)
      : options(given),
        parameters(toParameters(given)),
        plan(makeRunPlan(parameters)),
        record(parameters, plan, secretOf(given)),
        poser(parameters, record.secret()) {
    poser.checkFrames(plan.problems);
    record.noteClient(options.client, "");
  }

  Reply replyTo(const PosedProblem& posed, const OfflineReply& given) const {
    if (!given.defect.empty()) return without(Outcome::kRejected, given.defect);
    pcrb_msgs::SubmitPose::Request request = given.request;
    if (const auto rejection = checkContent(request)) {
      return without(Outcome::kRejected, rejection->message);
    }
    const Eigen::Vector3d& origin = posed.target->cloud.local_origin;
    if (options.in_dataset_frame && !origin.isZero()) {
      request.pose.pose =
          toMessage(toMapFrame(fromMessage(request.pose.pose), origin, parameters.presentation));
    }
    return makeReply(request, std::nullopt);
  }

  Result resultOf(const PlannedProblem& planned,
                  const std::map<std::string, OfflineReply>& replies) {
    const PosedProblem posed = poser.pose(planned);
    for (const auto& cloud : {posed.target, posed.source}) {
      record.noteCloud(cloud->name, cloud->hash);
    }
    const auto found = replies.find(planned.key.problem_id);
    return scoreReply(posed, found == replies.end()
                                 ? without(Outcome::kTimedOut, "there is no pose of this problem")
                                 : replyTo(posed, found->second));
  }

  OfflineRunOptions options;
  ServerParameters parameters;
  RunPlan plan;
  RunRecord record;
  ProblemPoser poser;
};

OfflineRun::OfflineRun(const OfflineRunOptions& options) : impl_(std::make_unique<Impl>(options)) {}

OfflineRun::~OfflineRun() = default;

std::size_t OfflineRun::size() const { return impl_->plan.problems.size(); }

std::string OfflineRun::score(const std::map<std::string, OfflineReply>& replies,
                              const std::function<void()>& on_row) {
  const std::set<ProblemKey> finished = impl_->record.finished();
  for (const auto& planned : impl_->plan.problems) {
    if (finished.count(planned.key) == 0) impl_->record.add(impl_->resultOf(planned, replies));
    on_row();
  }
  const std::string summary = formatSummary(impl_->record.summary());
  impl_->record.writeExports(summary);
  return summary;
}

}  // namespace pcrb
