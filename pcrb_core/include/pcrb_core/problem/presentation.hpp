#pragma once

#include <string>

#include "pcrb_core/point_cloud.hpp"
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
  /// Give each target, with its sources and guesses, a secret rigid motion of its own, and publish
  /// of each cloud a secret part in a secret order, so that nothing that a client remembers of
  /// another problem helps it (docs/interface.md).
  bool audit = false;

  bool isLocalization() const { return kind == PresentationKind::kLocalization; }
};

/// One problem as it is put to a client, in the target's local frame.
///
/// In either presentation the client gets `applied · source` and `target_applied · target`.
struct Presentation {
  Transform applied = Transform::Identity();  ///< source at ground truth → source as published
  Transform guess = Transform::Identity();    ///< T_target_source to start from
  Transform target_applied = Transform::Identity();  ///< target → target as published; for audits

  /// The reply that leaves nothing.
  Transform ideal() const { return target_applied * applied.inverse(); }

  /// What is left, in the target's local frame, when a reply is composed with what was applied;
  /// identity is perfect.
  Transform residual(const Transform& reply) const {
    return target_applied.inverse() * reply * applied;
  }
};

/// Registration: the source is published as P · source, the guess is the identity.
Presentation presentForRegistration(const Transform& P);

/// Localization: the source is published in its sensor's frame as V⁻¹ · source, the guess is P ·
/// V.
///
/// @param V  T_target_sensor, secretly turned (secretSensorPose).
Presentation presentForLocalization(const Transform& P, const Transform& V);

/// The same problem with its target moved by A, of which a client learns nothing: the source in the
/// target's frame and the guess move with it.
///
/// @param kind  in localization the source is in its sensor's frame, which stays.
Presentation moved(const Presentation& presentation, const Transform& A, PresentationKind kind);

/// The secret motion that an audit gives a target: its middle goes to a secret place within 50 m of
/// the origin on each axis, and it is turned about that by a secret rotation, uniform, or about z
/// alone if `about_z`.
///
/// @param subject  names the target.
/// @param middle   of the target, m, local frame.
Transform secretTargetMotion(const Secret& secret, const std::string& subject,
                             const Eigen::Vector3d& middle, bool about_z);

/// The part of a cloud that an audit publishes: 95 % of its points (rounded up), in a secret order.
///
/// @param subject  names the cloud and the problem.
PointCloud secretPart(const PointCloud& cloud, const Secret& secret, const std::string& subject);

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
