#include <algorithm>
#include <sstream>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/text.hpp"
#include "pcrb_server/message_conversion.hpp"
#include "pcrb_server/playback/playback.hpp"
#include "playback/scene_parts.hpp"
#include "ros/problem_messages.hpp"

namespace pcrb {

namespace {

/// The secret, or one that nothing secret is derived from.
Secret secretOf(const ProblemsOptions& options) {
  if (!options.needsSecret()) return Secret::fromHex(std::string(32, '0'));
  if (options.secret) return *options.secret;
  throw InvalidParameter("found no secret, expected one for problems without ground truth");
}

std::string describeProblem(const PosedProblem& posed) {
  std::ostringstream text;
  text.precision(3);
  text << "overlap " << posed.planned->problem.overlap << "\ninitial misalignment "
       << posed.initial.error;
  return text.str();
}

class ProblemPlayback : public Playback {
 public:
  explicit ProblemPlayback(const ProblemsOptions& options)
      : options_(options),
        names_{options.map_frame, options.scan_frame},
        secret_(secretOf(options)),
        problems_(makeRunPlan(options.configuration.selection).problems),
        poser_(options.configuration.selection.root, options.configuration.presentation, secret_),
        frames_(options.map_frame) {
    keepChosen();
    if (!options.publish_ground_truth) problems_ = inServingOrder(problems_, secret_);
    poser_.checkFrames(problems_);
  }

  std::size_t size() const override { return problems_.size(); }

  Scene next(const ros::Time& stamp) override {
    if (position_ == problems_.size()) position_ = 0;
    const PlannedProblem& planned = problems_[position_];
    const bool is_new_target = position_ == 0 || shown_ != planned.target_path;
    shown_ = planned.target_path;
    const PosedProblem posed = poser_.pose(planned);
    Scene scene = problemScene(posed, stamp, is_new_target,
                               names_.source(options_.configuration.presentation), frames_);
    scene.title = planned.subject();
    if (is_new_target) target_stamp_ = stamp;
    announce(scene, posed);
    if (options_.publish_ground_truth) showTruth(scene, posed);
    ++position_;
    return scene;
  }

  void seek(std::size_t position) override { position_ = position; }

 private:
  void keepChosen() {
    if (options_.ids.empty()) return;
    const auto is_unwanted = [&](const PlannedProblem& planned) {
      return !contains(options_.ids, planned.key.problem_id);
    };
    problems_.erase(std::remove_if(problems_.begin(), problems_.end(), is_unwanted),
                    problems_.end());
    if (!problems_.empty()) return;
    throw InvalidParameter("problem: found no problem " + joined(options_.ids) +
                           " in the file of the sequence, expected an id of its first column");
  }

  void announce(Scene& scene, const PosedProblem& posed) const {
    Announcement announcement;
    announcement.problem_id = options_.publish_ground_truth
                                  ? posed.planned->key.problem_id
                                  : secret_.publicId(posed.planned->subject());
    announcement.stamp = scene.stamp;
    announcement.index = static_cast<std::uint32_t>(position_);
    announcement.count = static_cast<std::uint32_t>(problems_.size());
    scene.problem =
        problemMessage(posed, announcement, target_stamp_, options_.configuration, names_);
    if (hasGuess(posed, options_.configuration)) {
      scene.initial_pose = initialPoseMessage(posed, scene.stamp, names_);
    }
  }

  void showTruth(Scene& scene, const PosedProblem& posed) const {
    scene.clouds.emplace_back(
        topics::kSourceTrue,
        toMessage(posed.source->cloud, Transform::Identity(), makeHeader(names_.map, scene.stamp)));
    scene.caption = captionOf(posed);
    addText(scene, posed, posed.P, describeProblem(posed), names_.map);
    if (options_.configuration.presentation.isLocalization()) {
      // Where the guess puts the scan: so it is seen as perturbed in this presentation, too.
      scene.transforms.transforms.push_back(
          toMessage(posed.presentation.guess, makeHeader(names_.map, scene.stamp), names_.scan));
    }
  }

  ProblemsOptions options_;
  ProblemFrames names_;
  Secret secret_;
  std::vector<PlannedProblem> problems_;
  ProblemPoser poser_;
  SceneFrames frames_;
  ros::Time target_stamp_;
  std::string shown_;  ///< path of the target in the last scene
  std::size_t position_ = 0;
};

}  // namespace

std::unique_ptr<Playback> playProblems(const ProblemsOptions& options) {
  return std::make_unique<ProblemPlayback>(options);
}

}  // namespace pcrb
