#include "server/problem_message.hpp"

#include "pcrb_server/message_conversion.hpp"

namespace pcrb {

std::uint8_t kindNumber(Kind kind) {
  return kind == Kind::kLocal ? pcrb_msgs::Problem::LOCAL : pcrb_msgs::Problem::GLOBAL;
}

bool hasGuess(const PosedProblem& posed, const ServerParameters& parameters) {
  return posed.planned->key.kind == Kind::kLocal || parameters.global_guess;
}

pcrb_msgs::Problem problemMessage(const PosedProblem& posed, const Announcement& announcement,
                                  const ros::Time& target_stamp,
                                  const ServerParameters& parameters) {
  const bool has_guess = hasGuess(posed, parameters);
  pcrb_msgs::Problem problem;
  problem.header = makeHeader(parameters.map_frame, announcement.stamp);
  problem.problem_id = announcement.problem_id;
  problem.data_set = posed.planned->key.data_set;
  problem.kind = kindNumber(posed.planned->key.kind);
  problem.presentation =
      static_cast<std::uint8_t>(parameters.isLocalization() ? pcrb_msgs::Problem::LOCALIZATION
                                                            : pcrb_msgs::Problem::REGISTRATION);
  problem.index = announcement.index;
  problem.count = announcement.count;
  problem.target_stamp = target_stamp;
  problem.source_frame = parameters.sourceFrame();
  problem.has_guess = has_guess ? 1 : 0;
  problem.initial_guess = toMessage(has_guess ? posed.presentation.guess : Transform::Identity());
  problem.time_limit = ros::Duration(parameters.time_limit);
  return problem;
}

geometry_msgs::PoseWithCovarianceStamped initialPoseMessage(const PosedProblem& posed,
                                                            const ros::Time& stamp,
                                                            const ServerParameters& parameters) {
  geometry_msgs::PoseWithCovarianceStamped pose;
  pose.header = makeHeader(parameters.map_frame, stamp);
  pose.pose.pose = toMessage(posed.presentation.guess);
  return pose;
}

}  // namespace pcrb
