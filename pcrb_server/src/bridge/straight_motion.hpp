#pragma once

namespace pcrb {

/// A robot's way along its x axis: it sets off and brakes evenly, and never jumps. Times in s, of
/// any clock that does not go back.
class StraightMotion {
 public:
  static constexpr double kAcceleration = 2.0;  ///< m/s²

  struct State {
    double position = 0.0;      ///< m
    double velocity = 0.0;      ///< m/s
    double acceleration = 0.0;  ///< m/s²
  };

  /// From this time on the robot changes to a speed, m/s.
  /// @param time  not before that of the call before.
  void changeTo(double speed, double time);

  /// @param time  not before that of the last change.
  State at(double time) const;

  /// s from a time until the speed that was asked for is reached.
  double timeToSpeed(double time) const;

 private:
  double start_ = 0.0;  ///< time of the last change
  State at_start_;
  double speed_ = 0.0;  ///< asked for
};

}  // namespace pcrb
