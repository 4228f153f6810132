#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cmath>

#include "pcrb_core/evaluation/correspondence_error.hpp"
#include "pcrb_core/transform.hpp"

int main() {
  const Eigen::Matrix3d quarter_turn =
      Eigen::AngleAxisd(std::acos(0.0), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const bool turns = std::abs(pcrb::rotationAngle(quarter_turn) - std::acos(0.0)) < 1e-12;

  pcl::PointCloud<pcl::PointXYZ> aligned, ground_truth;
  for (const float x : {-1.0F, 1.0F}) {
    aligned.push_back({x, 0.0F, 0.0F});
    ground_truth.push_back({x, 0.5F, 0.0F});
  }
  const bool scores = pcrb::error(aligned, ground_truth) == 0.5 &&
                      pcrb::error({{-1, 0, 0}, {1, 0, 0}}, {{-1, 0.5, 0}, {1, 0.5, 0}}) == 0.5;
  return turns && scores ? 0 : 1;
}
