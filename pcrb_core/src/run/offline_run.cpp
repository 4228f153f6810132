#include "pcrb_core/run/offline_run.hpp"

#include <set>

#include "pcrb_core/run/problem_poser.hpp"
#include "pcrb_core/run/run_plan.hpp"
#include "pcrb_core/run/run_record.hpp"
#include "pcrb_core/run/summary.hpp"

namespace pcrb {

namespace {

Reply replyWithoutPose(Outcome outcome, const std::string& reason) {
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

/// The same pose in the map's frame.
Submission toMapFrame(Submission submission, const Eigen::Vector3d& local_origin,
                      PresentationKind presentation) {
  const Transform T = toMapFrame(makeTransform(submission.position, submission.orientation),
                                 local_origin, presentation);
  submission.position = T.translation();
  submission.orientation = Eigen::Quaterniond(T.linear()).normalized();
  return submission;
}

}  // namespace

struct OfflineRun::Impl {
  explicit Impl(const OfflineRunOptions& given)
      : options(given),
        plan(makeRunPlan(given.configuration.selection)),
        record(given.run, given.configuration, plan, given.secret),
        poser(given.configuration.selection.root, given.configuration.presentation,
              record.secret()) {
    poser.checkFrames(plan.problems);
    record.noteClient(options.client, "");
  }

  Reply replyTo(const PosedProblem& posed, const OfflineReply& given) const {
    if (!given.defect.empty()) return replyWithoutPose(Outcome::kRejected, given.defect);
    if (const auto defect = checkSubmission(given.submission)) {
      return replyWithoutPose(Outcome::kRejected, defect->message);
    }
    const Eigen::Vector3d& origin = posed.target->cloud.local_origin;
    if (options.pose_frame == PoseFrame::kMap || origin.isZero()) {
      return makeReply(given.submission, std::nullopt);
    }
    return makeReply(toMapFrame(given.submission, origin, options.configuration.presentation.kind),
                     std::nullopt);
  }

  Result resultOf(const PlannedProblem& planned,
                  const std::map<std::string, OfflineReply>& replies) {
    const PosedProblem posed = poser.pose(planned);
    for (const auto& cloud : {posed.target, posed.source}) {
      record.noteCloud(cloud->name, cloud->hash);
    }
    const auto found = replies.find(planned.key.problem_id);
    return pcrb::score(
        posed, found == replies.end()
                   ? replyWithoutPose(Outcome::kTimedOut, "there is no pose of this problem")
                   : replyTo(posed, found->second));
  }

  OfflineRunOptions options;
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
  const std::string summary = formatSummary(summarize(impl_->record.results()));
  impl_->record.writeExports(summary);
  return summary;
}

}  // namespace pcrb
