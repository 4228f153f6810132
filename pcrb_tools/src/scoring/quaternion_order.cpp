#include "scoring/quaternion_order.hpp"

#include "pcrb_core/evaluation/trajectory_error.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb_tools {

const char* orderHint(const std::vector<ReadRotation>& rotations) {
  constexpr double kWrong = 0.2;  // rad
  std::vector<double> as_read;
  std::vector<double> w_first;
  for (const auto& [truth, read] : rotations) {
    // Written w x y z, read x y z w.
    const Eigen::Quaterniond other(read.x(), read.y(), read.z(), read.w());
    as_read.push_back(pcrb::rotationAngle(truth.transpose() * read.toRotationMatrix()));
    w_first.push_back(pcrb::rotationAngle(truth.transpose() * other.toRotationMatrix()));
  }
  if (rotations.empty()) return "";
  const double median = pcrb::describeErrors(as_read).median;
  const bool is_suspect = median > kWrong && pcrb::describeErrors(w_first).median < median / 4.0;
  return is_suspect ? "the orientations are right if w is read first: expected qx qy qz qw in the "
                      "poses' rows"
                    : "";
}

}  // namespace pcrb_tools
