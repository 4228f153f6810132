#include <optional>
#include <string>
#include <vector>

#include "conversion.hpp"
#include "pcrb_core/evaluation/correspondence_error.hpp"
#include "pcrb_core/evaluation/metric.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/problem/perturbation.hpp"
#include "pcrb_core/problem/problem.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb_python {
namespace {

py::dict readPcd(const std::string& path, int threads) {
  pcrb::DatasetCloud cloud;
  {
    const py::gil_scoped_release release;
    cloud = pcrb::readPcd(path, {threads});
  }
  py::dict result;
  result["points"] = toArray(cloud.points);
  result["intensity"] = intensityArray(cloud.intensity);
  result["viewpoint"] = py::none();
  if (cloud.hasViewpoint()) {
    result["viewpoint"] = py::cast(Eigen::Matrix4d(cloud.viewpoint.matrix()));
  }
  result["dropped_non_finite"] = cloud.dropped_non_finite;
  return result;
}

void writePcd(const std::string& path, const Array& points, const std::optional<Rows>& viewpoint) {
  pcrb::DatasetCloud cloud = toCloud(points);
  cloud.is_viewpoint_known = viewpoint.has_value();  // even if it is the identity
  if (viewpoint) cloud.viewpoint = pcrb::requireRigid(*viewpoint);
  pcrb::writePcd(path, cloud);
}

/// The cloud near its origin and the transform there: what Metric wants.
py::dict evaluate(const Array& source, const Rows& T_residual) {
  const pcrb::DatasetCloud cloud = toCloud(source);
  const Eigen::Vector3d origin = pcrb::chooseLocalOrigin(cloud);
  const pcrb::Metric metric(pcrb::makeLocal(cloud, origin));
  const pcrb::Transform T = pcrb::inLocalFrame(pcrb::requireRigid(T_residual), origin);
  const pcrb::PoseError error = metric.evaluate(T);
  py::dict result;
  result["error"] = error.error;
  result["rotation_error_rad"] = error.rotation_error;
  result["translation_error_m"] = error.translation_error;
  result["mean_distance_m"] = metric.unnormalized(T);
  return result;
}

double errorBetween(const Array& aligned, const Array& ground_truth) {
  return pcrb::error(toCloud(aligned).points, toCloud(ground_truth).points);
}

Array moved(const Array& points, const Rows& rows) {
  const pcrb::Transform T = pcrb::requireRigid(rows);
  std::vector<Eigen::Vector3d> result = toCloud(points).points;
  for (auto& point : result) point = T * point;
  return toArray(result);
}

Eigen::Matrix4d perturbationAbout(const Array& points, const Eigen::Vector3d& translation,
                                  const Eigen::Matrix3d& rotation) {
  Rows checked;
  checked << rotation, translation;
  pcrb::requireRigid(checked);
  return pcrb::makePerturbation(pcrb::centroid(toCloud(points)), translation, rotation).matrix();
}

Eigen::Vector3d localOrigin(const Array& target) {
  return pcrb::chooseLocalOrigin(toCloud(target));
}

}  // namespace

void defineClouds(py::module& module) {
  module.def("error", &errorBetween);
  module.def("evaluate", &evaluate);
  module.def("read_pcd", &readPcd);
  module.def("write_pcd", &writePcd);
  module.def("move", &moved);
  module.def("perturbation_about", &perturbationAbout);
  module.def("local_origin", &localOrigin);
}

}  // namespace pcrb_python
