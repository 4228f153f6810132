#include "bridge/straight_motion.hpp"

#include <algorithm>
#include <cmath>

namespace pcrb {

void StraightMotion::changeTo(double speed, double time) {
  at_start_ = at(time);
  start_ = time;
  speed_ = speed;
}

StraightMotion::State StraightMotion::at(double time) const {
  const double elapsed = std::max(0.0, time - start_);
  const double ramp = std::abs(speed_ - at_start_.velocity) / kAcceleration;
  const double acceleration = std::copysign(kAcceleration, speed_ - at_start_.velocity);
  const double ramped = std::min(elapsed, ramp);
  State state;
  state.position = at_start_.position + at_start_.velocity * ramped +
                   0.5 * acceleration * ramped * ramped + speed_ * (elapsed - ramped);
  state.velocity = elapsed < ramp ? at_start_.velocity + acceleration * elapsed : speed_;
  state.acceleration = elapsed < ramp ? acceleration : 0.0;
  return state;
}

double StraightMotion::timeToSpeed(double time) const {
  return std::max(0.0, std::abs(speed_ - at_start_.velocity) / kAcceleration - (time - start_));
}

}  // namespace pcrb
