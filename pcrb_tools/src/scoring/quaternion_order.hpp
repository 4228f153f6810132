#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace pcrb_tools {

/// A rotation as it was read, and what it should be.
struct ReadRotation {
  Eigen::Matrix3d truth;
  Eigen::Quaterniond read;
};

/// What to say of rotations that are right only if w is read first; empty where nothing is.
const char* orderHint(const std::vector<ReadRotation>& rotations);

}  // namespace pcrb_tools
