#include "ros/problem_messages.hpp"

#include "pcrb_server/message_conversion.hpp"

namespace pcrb {

std::uint8_t kindNumber(Kind kind) {
  return kind == Kind::kLocal ? pcrb_msgs::Problem::LOCAL : pcrb_msgs::Problem::GLOBAL;
}

bool hasGuess(const PosedProblem& posed, const RunConfiguration& configuration) {
  return posed.planned->key.kind == Kind::kLocal || configuration.global_guess;
}

pcrb_msgs::Problem problemMessage(const PosedProblem& posed, const Announcement& announcement,
                                  const ros::Time& target_stamp,
                                  const RunConfiguration& configuration,
                                  const ProblemFrames& frames) {
  const bool has_guess = hasGuess(posed, configuration);
  const bool is_localization = configuration.presentation.isLocalization();
  pcrb_msgs::Problem problem;
  problem.header = makeHeader(frames.map, announcement.stamp);
  problem.problem_id = announcement.problem_id;
  problem.data_set = posed.planned->key.data_set;
  problem.voxel_leaf = posed.planned->data_set->voxel_leaf;
  problem.kind = kindNumber(posed.planned->key.kind);
  problem.presentation = static_cast<std::uint8_t>(
      is_localization ? pcrb_msgs::Problem::LOCALIZATION : pcrb_msgs::Problem::REGISTRATION);
  problem.index = announcement.index;
  problem.count = announcement.count;
  problem.target_stamp = target_stamp;
  problem.source_frame = frames.source(configuration.presentation);
  problem.has_guess = has_guess ? 1 : 0;
  problem.initial_guess = toMessage(has_guess ? posed.presentation.guess : Transform::Identity());
  problem.time_limit = ros::Duration(configuration.time_limit);
  return problem;
}

geometry_msgs::PoseWithCovarianceStamped initialPoseMessage(const PosedProblem& posed,
                                                            const ros::Time& stamp,
                                                            const ProblemFrames& frames) {
  geometry_msgs::PoseWithCovarianceStamped pose;
  pose.header = makeHeader(frames.map, stamp);
  pose.pose.pose = toMessage(posed.presentation.guess);
  return pose;
}

}  // namespace pcrb
