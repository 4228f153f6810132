#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pcrb_core/error.hpp"
#include "pcrb_core/point_cloud.hpp"
#include "pcrb_core/pose_covariance.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb {

/// What an alignment came to.
struct RegistrationResult {
  Transform T_target_source = Transform::Identity();  ///< p_target = T_target_source · p_source
  bool converged = false;  ///< false: the method's best pose, but its own criterion was not met
  std::string reason;      ///< why not, where it did not converge; else empty
  int iterations = 0;
  double solver_time = 0.0;  ///< s of align(), steady clock; set by align() itself
  /// Of T_target_source, about the axes of the target's frame; nothing where the method knows none.
  std::optional<PoseCovariance> covariance;
};

/// A method has no answer for a pair of clouds, say for lack of matching features.
class RegistrationFailed : public Error {
 public:
  using Error::Error;
};

/// Parameters of a method by name, as text; each method checks its own.
using Parameters = std::map<std::string, std::string>;

/// A registration method. It sees a target, a source and an initial guess, nothing else.
///
/// Deterministic: the same clouds, guess and parameters give the same result at any thread count.
/// Methods implement prepareTarget() and alignSource(); what is common to all is done here.
class Registration {
 public:
  virtual ~Registration() = default;

  /// Sets the cloud that stays, and does all the work that depends on it alone (trees, covariances,
  /// features). That work is kept until the next call; after an error there is no target.
  ///
  /// @throws InvalidProblem  if the cloud is null, empty, has a point that is not finite, or has
  /// too few points for the method.
  void setTarget(const std::shared_ptr<const PointCloud>& target);

  /// Aligns a source with the target.
  ///
  /// @param source  same local origin as the target.
  /// @param T_target_source_guess  where to start; methods that need no guess ignore it.
  /// @throws InvalidProblem  for input that cannot be aligned: no target, another local origin,
  /// points or a guess that are not finite, too few points.
  /// @throws RegistrationFailed  if the method has no answer.
  RegistrationResult align(const PointCloud& source, const Transform& T_target_source_guess);

 protected:
  /// Does the work that depends on the target alone. Both clouds of a method come in double-checked
  /// and relative to one origin near the target's centroid, whatever the data set's coordinates.
  /// May throw as alignSource() may.
  virtual void prepareTarget(const PointCloud& target) = 0;

  /// Aligns a source with the target prepared last; guess and result are relative to its origin.
  ///
  /// May throw InvalidProblem (these clouds cannot be aligned) or RegistrationFailed (no answer);
  /// the object is used again afterwards. Anything else, say std::bad_alloc or an exception of a
  /// library, passes through align(): registration_node then answers `failed` with its what(), and
  /// goes on with a new object.
  virtual RegistrationResult alignSource(const PointCloud& source,
                                         const Transform& T_target_source_guess) = 0;

 private:
  bool has_target_ = false;
  Eigen::Vector3d local_origin_ = Eigen::Vector3d::Zero();    // m, of the target as given
  Eigen::Vector3d working_origin_ = Eigen::Vector3d::Zero();  // m, relative to local_origin_
};

/// Makes a method by its name.
///
/// @throws InvalidParameter  if the method is unknown (the message lists the known ones), or with
/// all unknown names, wrong types and impossible values in one message.
std::unique_ptr<Registration> makeRegistration(const std::string& method,
                                               const Parameters& parameters);

/// Names that makeRegistration knows, sorted.
std::vector<std::string> registrationMethods();

/// All parameters of a method with their default values.
///
/// @throws InvalidParameter  if the method is unknown.
Parameters registrationDefaults(const std::string& method);

}  // namespace pcrb
