#include <sstream>

#include "pcrb_core/error.hpp"
#include "pcrb_server/message_conversion.hpp"
#include "pcrb_server/playback/playback.hpp"
#include "playback/problem_scene.hpp"
#include "server/problem_message.hpp"

namespace pcrb {

namespace {

ServerParameters toParameters(const ProblemsOptions& options) {
  ServerParameters parameters;
  parameters.root = options.root;
  parameters.sequences = options.sequences;
  parameters.kinds = options.kinds;
  parameters.presentation = options.presentation;
  parameters.upright = options.upright;
  parameters.subset = options.subset;
  parameters.seed = options.seed;
  parameters.time_limit = options.time_limit;
  parameters.map_frame = options.map_frame;
  parameters.scan_frame = options.scan_frame;
  return parameters;
}

/// The secret, or one that nothing secret is derived from.
Secret secretOf(const ProblemsOptions& options) {
  const bool is_needed = !options.truth || options.presentation == PresentationKind::kLocalization;
  if (!is_needed) return Secret::fromHex(std::string(32, '0'));
  return Secret::fromHex(options.secret);
}

std::string describe(const PosedProblem& posed) {
  std::ostringstream text;
  text.precision(3);
  text << "overlap " << posed.planned->problem.overlap << "\ninitial misalignment "
       << posed.initial.error;
  return text.str();
}

class ProblemPlayback : public Playback {
 public:
  explicit ProblemPlayback(const ProblemsOptions& options)
      : parameters_(toParameters(options)),
        truth_(options.truth),
        secret_(secretOf(options)),
        problems_(makeRunPlan(parameters_).problems),
        poser_(parameters_, secret_),
        frames_(options.map_frame) {
    if (!truth_) problems_ = inServingOrder(problems_, secret_);
    poser_.checkFrames(problems_);
  }

  std::size_t size() const override { return problems_.size(); }

  Scene next(const ros::Time& stamp) override {
    if (position_ == problems_.size()) position_ = 0;
    const PlannedProblem& planned = problems_[position_];
    const bool is_new_target =
        position_ == 0 || problems_[position_ - 1].target_path != planned.target_path;
    const PosedProblem posed = poser_.pose(planned);
    Scene scene = problemScene(posed, stamp, is_new_target, frames_, parameters_);
    scene.title = planned.subject();
    if (is_new_target) target_stamp_ = stamp;
    announce(scene, posed);
    if (truth_) showTruth(scene, posed);
    ++position_;
    return scene;
  }

 private:
  void announce(Scene& scene, const PosedProblem& posed) const {
    Announcement announcement;
    announcement.problem_id =
        truth_ ? posed.planned->key.problem_id : secret_.publicId(posed.planned->subject());
    announcement.stamp = scene.stamp;
    announcement.index = static_cast<std::uint32_t>(position_);
    announcement.count = static_cast<std::uint32_t>(problems_.size());
    scene.problem = problemMessage(posed, announcement, target_stamp_, parameters_);
    if (hasGuess(posed, parameters_)) {
      scene.initial_pose = initialPoseMessage(posed, scene.stamp, parameters_);
    }
  }

  void showTruth(Scene& scene, const PosedProblem& posed) const {
    scene.clouds.emplace_back(topics::kSourceTrue,
                              toMessage(posed.source->cloud, Transform::Identity(),
                                        makeHeader(parameters_.map_frame, scene.stamp)));
    addText(scene, posed, posed.P, describe(posed), parameters_.map_frame);
    if (parameters_.isLocalization()) {
      // Where the guess puts the scan: so it is seen as perturbed in this presentation, too.
      scene.transforms.transforms.push_back(
          toMessage(posed.presentation.guess, makeHeader(parameters_.map_frame, scene.stamp),
                    parameters_.scan_frame));
    }
  }

  ServerParameters parameters_;
  bool truth_;
  Secret secret_;
  std::vector<PlannedProblem> problems_;
  ProblemPoser poser_;
  SceneFrames frames_;
  ros::Time target_stamp_;
  std::size_t position_ = 0;
};

}  // namespace

std::unique_ptr<Playback> playProblems(const ProblemsOptions& options) {
  return std::make_unique<ProblemPlayback>(options);
}

}  // namespace pcrb
