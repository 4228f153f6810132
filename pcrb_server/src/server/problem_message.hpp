#pragma once

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <pcrb_msgs/Problem.h>
#include <ros/time.h>

#include <string>

#include "server/problem_poser.hpp"
#include "server/server_parameters.hpp"

namespace pcrb {

/// Where a problem stands in its run, and what it is called there.
struct Announcement {
  std::string problem_id;  ///< random
  ros::Time stamp;
  std::uint32_t index = 0;
  std::uint32_t count = 0;
};

/// The constant of pcrb_msgs/Problem.
std::uint8_t kindNumber(Kind kind);

/// Whether an initial guess goes with the problem.
bool hasGuess(const PosedProblem& posed, const ServerParameters& parameters);

pcrb_msgs::Problem problemMessage(const PosedProblem& posed, const Announcement& announcement,
                                  const ros::Time& target_stamp,
                                  const ServerParameters& parameters);

/// The initial guess, for problems that have one.
geometry_msgs::PoseWithCovarianceStamped initialPoseMessage(const PosedProblem& posed,
                                                            const ros::Time& stamp,
                                                            const ServerParameters& parameters);

}  // namespace pcrb
