#pragma once

#include <optional>

#include "pcrb_core/transform.hpp"

namespace pcrb {

/// The benchmark's poses are those of the sensor, a localization node's those of its body
/// (`base_link`). With E = T_body_sensor one follows from the other.

/// T_map_body of a sensor's pose: T_map_sensor · E⁻¹.
inline Transform bodyPose(const Transform& T_map_sensor, const Transform& T_body_sensor) {
  return T_map_sensor * T_body_sensor.inverse();
}

/// T_map_sensor of a body's pose: T_map_body · E.
inline Transform sensorPose(const Transform& T_map_body, const Transform& T_body_sensor) {
  return T_map_body * T_body_sensor;
}

/// The rotation that takes the points of an optical frame (REP 103: z forward, x right, y down) to
/// the axes of a body (x forward, y left, z up) at the same place, and rolls it upright, so that
/// its y lies level in the map where the initial guess puts it.
///
/// @param T_map_optical  the initial guess; without one the roll stays as it is.
Transform uprightFromOptical(const std::optional<Transform>& T_map_optical);

}  // namespace pcrb
