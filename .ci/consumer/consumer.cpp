#include <cmath>

#include "pcrb_core/transform.hpp"

int main() {
  const Eigen::Matrix3d quarter_turn =
      Eigen::AngleAxisd(std::acos(0.0), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return std::abs(pcrb::rotationAngle(quarter_turn) - std::acos(0.0)) < 1e-12 ? 0 : 1;
}
