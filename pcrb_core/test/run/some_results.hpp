#pragma once

#include <string>

#include "pcrb_core/run/result.hpp"

namespace pcrb_test {

/// A result without anything that may be unknown.
inline pcrb::Result minimalResult(const std::string& id) {
  pcrb::Result result;
  result.key = {"eth", "plain", pcrb::Kind::kLocal, id};
  result.source = "a.pcd";
  result.target = "b.pcd";
  result.overlap = 0.5;
  result.outcome = pcrb::Outcome::kTimedOut;
  result.reason = "no reply";
  result.error = 0.3;
  result.initial_misalignment = 0.3;
  result.rotation_error = 0.01;
  result.translation_error = 0.2;
  result.finished = 1700000000.5;
  return result;
}

/// A result with everything.
inline pcrb::Result fullResult(const std::string& id) {
  pcrb::Result result = minimalResult(id);
  result.overlap = 0.4567;
  result.outcome = pcrb::Outcome::kReplied;
  result.reason = "";
  result.error = 0.1;
  result.runtime = 1.25;
  result.solver_time = 1.0;
  result.scans_used = 3;
  result.target_changed = true;
  result.replies_rejected = 2;
  result.position = Eigen::Vector3d(1.5, -2.5, 1e-300);
  result.orientation = Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5);
  result.covariance.emplace();
  for (std::size_t i = 1; i < 36; ++i) (*result.covariance)[i] = static_cast<double>(i) + 0.5;
  (*result.covariance)[0] = 0.0;
  result.finished = 1700000000.25;
  return result;
}

}  // namespace pcrb_test
