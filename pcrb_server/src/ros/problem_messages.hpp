#pragma once

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <pcrb_msgs/Problem.h>
#include <ros/time.h>

#include <string>

#include "pcrb_core/run/problem_poser.hpp"
#include "pcrb_core/run/run_info.hpp"

namespace pcrb {

/// Names of the frames that problems are in.
struct ProblemFrames {
  std::string map = "map";         ///< of the target
  std::string scan = "pcrb_scan";  ///< of the source in localization

  /// Frame of the source as it is published.
  const std::string& source(const PresentationOptions& presentation) const {
    return presentation.isLocalization() ? scan : map;
  }
};

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
bool hasGuess(const PosedProblem& posed, const RunConfiguration& configuration);

pcrb_msgs::Problem problemMessage(const PosedProblem& posed, const Announcement& announcement,
                                  const ros::Time& target_stamp,
                                  const RunConfiguration& configuration,
                                  const ProblemFrames& frames);

/// The initial guess, for problems that have one.
geometry_msgs::PoseWithCovarianceStamped initialPoseMessage(const PosedProblem& posed,
                                                            const ros::Time& stamp,
                                                            const ProblemFrames& frames);

}  // namespace pcrb
