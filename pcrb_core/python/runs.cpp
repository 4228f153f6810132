#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "conversion.hpp"
#include "pcrb_core/run/in_process_run.hpp"
#include "pcrb_core/run/results_store.hpp"

namespace pcrb_python {
namespace {

template <typename Value>
py::object orNone(const std::optional<Value>& value) {
  return value ? py::cast(*value) : py::object(py::none());
}

py::dict toRow(const pcrb::Result& result) {
  py::dict row;
  row["data_set"] = textOf(result.key.data_set);
  row["sequence"] = textOf(result.key.sequence);
  row["kind"] = toString(result.key.kind);
  row["problem_id"] = textOf(result.key.problem_id);
  row["source"] = textOf(result.source);
  row["target"] = textOf(result.target);
  row["overlap"] = result.overlap;
  row["outcome"] = toString(result.outcome);
  row["reason"] = textOf(result.reason);
  row["error"] = result.error;
  row["initial_misalignment"] = result.initial_misalignment;
  row["rotation_error_rad"] = result.rotation_error;
  row["translation_error_m"] = result.translation_error;
  row["runtime_s"] = orNone(result.runtime);
  row["solver_time_s"] = orNone(result.solver_time);
  row["position"] = orNone(result.position);
  row["orientation"] = py::none();
  if (result.orientation) row["orientation"] = py::cast(result.orientation->coeffs().eval());
  row["covariance"] = orNone(result.covariance);
  return row;
}

py::list readResults(const std::string& folder) {
  const pcrb::ResultsStore store(folder, pcrb::ResultsStore::Access::kReadOnly);
  py::list list;
  for (const pcrb::Result& result : store.results()) list.append(toRow(result));
  return list;
}

py::dict readRunInfo(const std::string& folder) {
  const pcrb::ResultsStore store(folder, pcrb::ResultsStore::Access::kReadOnly);
  py::dict info;
  for (const auto& [key, value] : store.runInfo()) info[textOf(key)] = textOf(value);
  return info;
}

py::object cloudArray(const std::vector<float>& coordinates) {
  const auto rows = static_cast<py::ssize_t>(coordinates.size() / 3);
  return py::array_t<float>(std::vector<py::ssize_t>{rows, 3}, coordinates.data());
}

py::object nextProblem(pcrb::InProcessRun& run) {
  std::optional<pcrb::ClientProblem> problem;
  {
    const py::gil_scoped_release release;
    problem = run.next();
  }
  if (!problem) return py::none();
  py::dict fields;
  fields["id"] = textOf(problem->id);
  fields["data_set"] = textOf(problem->data_set);
  fields["sequence"] = textOf(problem->sequence);
  fields["kind"] = toString(problem->kind);
  fields["target"] = cloudArray(problem->target);
  fields["source"] = cloudArray(problem->source);
  fields["target_intensity"] = intensityArray(problem->target_intensity);
  fields["source_intensity"] = intensityArray(problem->source_intensity);
  fields["guess"] = py::cast(Eigen::Matrix4d(problem->guess.matrix()));
  fields["has_guess"] = problem->has_guess;
  fields["voxel_leaf"] = problem->voxel_leaf;
  return py::object(fields);
}

pcrb::Submission poseSubmission(const Eigen::Vector3d& position, const Eigen::Vector4d& xyzw) {
  pcrb::Submission submission;
  submission.position = position;
  submission.orientation.coeffs() = xyzw;
  return submission;
}

/// @param covariance  row-major x y z rx ry rz.
pcrb::Submission withCovariance(pcrb::Submission submission,
                                const pcrb::PoseCovariance& covariance) {
  submission.covariance = covariance;
  return submission;
}

pcrb::Submission failure(const std::string& reason) {
  pcrb::Submission submission;
  submission.status = pcrb::Submission::Status::kFailed;
  submission.reason = reason;
  return submission;
}

/// What a C++ client sends for a matrix.
py::tuple positionAndOrientation(const Rows& rows) {
  const pcrb::Transform T = pcrb::requireRigid(rows);
  const Eigen::Quaterniond q = Eigen::Quaterniond(T.linear()).normalized();
  return py::make_tuple(Eigen::Vector3d(T.translation()), Eigen::Vector4d(q.coeffs()));
}

std::unique_ptr<pcrb::InProcessRun> makeRun(const std::string& root,
                                            const std::vector<std::string>& sequences,
                                            const std::vector<std::string>& kinds,
                                            std::size_t subset, std::uint64_t seed,
                                            const std::string& presentation, double time_limit,
                                            const std::string& folder, const std::string& name) {
  pcrb::InProcessRunOptions options;
  options.run = folder;
  options.client = name;
  pcrb::RunConfiguration& configuration = options.configuration;
  configuration.under_test = name;
  configuration.selection = selectionOf(root, sequences, kinds, subset, seed);
  configuration.presentation.kind = pcrb::presentationFromString(presentation);
  configuration.time_limit = time_limit;
  return std::make_unique<pcrb::InProcessRun>(options);
}

void defineRun(py::module& module) {
  const py::class_<pcrb::Submission> submission_type(module, "Submission");
  module.def("pose", &poseSubmission);
  module.def("with_covariance", &withCovariance);
  module.def("failure", &failure);
  module.def("position_and_orientation", &positionAndOrientation);
  py::class_<pcrb::InProcessRun>(module, "Run")
      .def(py::init(&makeRun))
      .def("__len__", &pcrb::InProcessRun::size)
      .def("done", &pcrb::InProcessRun::done)
      .def("next", &nextProblem)
      .def("score", [](const pcrb::InProcessRun& run, const pcrb::Submission& submission,
                       double runtime) { return toRow(run.score(submission, runtime)); })
      .def("submit", [](pcrb::InProcessRun& run, const pcrb::Submission& submission,
                        double runtime) { return toRow(run.submit(submission, runtime)); })
      .def("finish", [](pcrb::InProcessRun& run) { return textOf(run.finish()); });
}

}  // namespace

void defineRuns(py::module& module) {
  defineRun(module);
  module.def("read_results", &readResults);
  module.def("read_run_info", &readRunInfo);
}

}  // namespace pcrb_python
