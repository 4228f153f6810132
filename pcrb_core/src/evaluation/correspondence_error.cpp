#include "pcrb_core/evaluation/correspondence_error.hpp"

#include <string>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

constexpr double kWeightless = 1e-9;  // m from the centroid

void requireFinite(const std::vector<Eigen::Vector3d>& points, const char* what) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) {
      throw InvalidProblem(std::string(what) + ": found point " + std::to_string(i) +
                           " not finite, expected finite points only");
    }
  }
}

std::vector<Eigen::Vector3d> inDataSetFrame(const PointCloud& cloud) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(cloud.size());
  for (const auto& point : cloud.points) {
    points.emplace_back(point.cast<double>() + cloud.local_origin);
  }
  return points;
}

}  // namespace

double error(const std::vector<Eigen::Vector3d>& aligned,
             const std::vector<Eigen::Vector3d>& ground_truth) {
  if (aligned.size() != ground_truth.size()) {
    throw InvalidProblem("error: found " + std::to_string(aligned.size()) + " aligned points and " +
                         std::to_string(ground_truth.size()) +
                         " at ground truth, expected as many of the one as of the other");
  }
  requireFinite(aligned, "aligned cloud");
  requireFinite(ground_truth, "ground truth");
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& point : aligned) sum += point - aligned.front();
  const Eigen::Vector3d centroid = sum / static_cast<double>(aligned.size());
  double ratios = 0.0;
  std::size_t weighted = 0;
  for (std::size_t i = 0; i < aligned.size(); ++i) {
    const double distance = (aligned[i] - aligned.front() - centroid).norm();
    if (distance <= kWeightless) continue;
    ratios += (aligned[i] - ground_truth[i]).norm() / distance;
    ++weighted;
  }
  if (weighted == 0) {
    throw InvalidProblem("error: found no point farther than 1e-9 m from the centroid");
  }
  return ratios / static_cast<double>(weighted);
}

double error(const PointCloud& aligned, const PointCloud& ground_truth) {
  return error(inDataSetFrame(aligned), inDataSetFrame(ground_truth));
}

}  // namespace pcrb
