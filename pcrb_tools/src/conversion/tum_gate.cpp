#include "conversion/tum_gate.hpp"

#include "pcrb_core/io/number.hpp"

namespace pcrb_tools {

double maxRate(const TumOptions& options, TumInput input) {
  constexpr double kPublishedRate = 2.0;
  return options.max_rate.value_or(input == TumInput::kClouds ? 0.0 : kPublishedRate);
}

TumGate::TumGate(const pcrb::Trajectory& trajectory, const TumOptions& options, double max_rate,
                 Conversion& conversion)
    : trajectory_(trajectory), options_(options), conversion_(conversion), limiter_(max_rate) {}

std::optional<pcrb::Transform> TumGate::admit(pcrb::Stamp stamp) {
  const auto drop = [&](const std::string& reason) {
    conversion_.drop(cloudName(stamp), reason);
    return std::nullopt;
  };
  if (clock_.goesBack(stamp)) conversion_.noteGoingBack();
  const pcrb::PoseLookup answer = poseAt(stamp);
  if (answer.status != pcrb::PoseStatus::kFound) return drop(pcrb::toString(answer.status));
  const bool is_due = limiter_.keep(stamp);  // asked of a repetition, too: it has its place in time
  if (admitted_.count(stamp) > 0) return drop("the stamp of an earlier one");
  if (!is_due) return drop("beyond the maximal rate");
  admitted_.insert(stamp);
  return answer.T_world_body;
}

pcrb::PoseLookup TumGate::poseAt(pcrb::Stamp stamp) const {
  if (!options_.nearest) return trajectory_.interpolate(stamp, options_.max_gap);
  return {pcrb::PoseStatus::kFound, trajectory_.nearest(stamp).T_world_body};
}

void noteTrajectory(const pcrb::Trajectory& trajectory, Conversion& conversion) {
  if (trajectory.duplicates() > 0) {
    conversion.note(std::to_string(trajectory.duplicates()) +
                    " poses have the stamp of a later one and were not used");
  }
}

std::string cameraText(const pcrb::Intrinsics& intrinsics, double units_per_metre) {
  std::string text = "camera";
  for (const double number :
       {intrinsics.fx, intrinsics.fy, intrinsics.cx, intrinsics.cy, units_per_metre}) {
    text += ' ' + pcrb::formatShortest(number);
  }
  return text;
}

}  // namespace pcrb_tools
