#pragma once

#include <string>

#include "pcrb_core/problem/secret.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb {

/// How a problem is put to a client; the score is the same (docs/interface.md).
enum class PresentationKind { kRegistration, kLocalization };

/// `registration` or `localization`.
const char* toString(PresentationKind kind);

/// @throws InvalidParameter  if the text is neither.
PresentationKind presentationFromString(const std::string& text);

/// How the problems of a run are put to its client.
struct PresentationOptions {
  PresentationKind kind = PresentationKind::kRegistration;
  /// Localization of scans without a viewpoint: turn them secretly about z alone, not by any
  /// rotation; gives their tilt away.
  bool yaw_only = false;

  bool isLocalization() const { return kind == PresentationKind::kLocalization; }
};

/// One problem as it is put to a client, in the target's local frame.
///
/// In either presentation the client gets `applied · source` and is ideally answered by applied⁻¹.
struct Presentation {
  Transform applied = Transform::Identity();  ///< source at ground truth → source as published
  Transform guess = Transform::Identity();    ///< T_target_source to start from

  /// What is left when a reply is composed with what was applied; identity is perfect.
  Transform residual(const Transform& reply) const { return reply * applied; }
};

/// Registration: the source is published as P · source, the guess is the identity.
Presentation presentForRegistration(const Transform& P);

/// Localization: the source is published in its sensor's frame as V⁻¹ · source, the guess is P ·
/// V.
///
/// @param V  T_target_sensor, secretly turned (secretSensorPose).
Presentation presentForLocalization(const Transform& P, const Transform& V);

/// The pose of a scan's sensor, turned by a secret rotation so that no client can repeat or guess
/// it.
///
/// With a viewpoint: turned by a secret yaw about the sensor's z. Without: the source's centroid
/// with a secret rotation, uniform, or about z alone if `yaw_only` (which gives the tilt away).
/// @param viewpoint  T_local_sensor; ignored where `has_viewpoint` is false.
/// @param centroid   of the source, m, local frame.
/// @param subject    names the problem.
Transform secretSensorPose(const Secret& secret, const std::string& subject, bool has_viewpoint,
                           const Transform& viewpoint, const Eigen::Vector3d& centroid,
                           bool yaw_only);

}  // namespace pcrb
