#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "pcrb_core/point_cloud.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb {

/// What an alignment came to.
struct RegistrationResult {
  Transform T_target_source = Transform::Identity();  ///< p_target = T_target_source · p_source
  bool converged = false;
  std::string reason;  ///< why not, where it did not converge; else empty
  int iterations = 0;
  double solver_time = 0.0;  ///< s, steady clock
};

/// Parameters of a method by name, as text; each method checks its own.
using Parameters = std::map<std::string, std::string>;

/// A registration method. It sees a target, a source and an initial guess, nothing else.
///
/// Deterministic: the same clouds, guess and parameters give the same result at any thread count.
class Registration {
 public:
  virtual ~Registration() = default;

  /// Sets the cloud that stays, and does all the work that depends on it alone (trees, covariances,
  /// features). Its work is kept until the next call.
  virtual void setTarget(std::shared_ptr<const PointCloud> target) = 0;

  /// Aligns a source with the target.
  ///
  /// @param source    same local origin as the target.
  /// @param T_target_source_guess  where to start; methods that need no guess ignore it.
  /// @throws Error  for clouds that cannot be aligned at all (too few points after filtering).
  virtual RegistrationResult align(const PointCloud& source,
                                   const Transform& T_target_source_guess) = 0;
};

/// Makes a method by its name.
///
/// @param parameters  unknown names, wrong types and impossible values are errors, all listed at
/// once.
/// @throws InvalidParameter  if the method is unknown (the message lists the known ones) or a
/// parameter
///                           is wrong.
std::unique_ptr<Registration> makeRegistration(const std::string& method,
                                               const Parameters& parameters);

/// Names that makeRegistration knows, sorted.
std::vector<std::string> registrationMethods();

}  // namespace pcrb
