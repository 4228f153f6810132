// The extension module pcrb._pcrb: C++ functions as they are. What users see, with names, checks
// and docstrings, is pcrb/__init__.py.

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pcrb_core/error.hpp"
#include "pcrb_core/evaluation/correspondence_error.hpp"
#include "pcrb_core/evaluation/metric.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/problem/dataset.hpp"
#include "pcrb_core/problem/perturbation.hpp"
#include "pcrb_core/problem/problem.hpp"
#include "pcrb_core/registration/registration.hpp"
#include "pcrb_core/run/in_process_run.hpp"
#include "pcrb_core/run/results_store.hpp"
#include "pcrb_core/run/run_plan.hpp"

namespace py = pybind11;

namespace {

using Array = py::array_t<double, py::array::c_style>;  // (n, 3)
using Rows = Eigen::Matrix<double, 3, 4>;

/// A text of any bytes, as a name of a file may be, as Python has it: with its own escapes.
py::object textOf(const std::string& bytes) {
  const auto size = static_cast<py::ssize_t>(bytes.size());
  return py::reinterpret_steal<py::object>(PyUnicode_DecodeFSDefaultAndSize(bytes.data(), size));
}

pcrb::DatasetCloud toCloud(const Array& array) {
  pcrb::DatasetCloud cloud;
  const auto rows = array.unchecked<2>();
  cloud.points.reserve(static_cast<std::size_t>(rows.shape(0)));
  for (py::ssize_t i = 0; i < rows.shape(0); ++i) {
    cloud.points.emplace_back(rows(i, 0), rows(i, 1), rows(i, 2));
    if (!cloud.points.back().allFinite()) {
      throw pcrb::InvalidProblem("found point " + std::to_string(i) +
                                 " not finite, expected finite points only");
    }
  }
  return cloud;
}

Array toArray(const std::vector<Eigen::Vector3d>& points) {
  Array array(std::vector<py::ssize_t>{static_cast<py::ssize_t>(points.size()), 3});
  auto rows = array.mutable_unchecked<2>();
  for (py::ssize_t i = 0; i < rows.shape(0); ++i) {
    for (py::ssize_t axis = 0; axis < 3; ++axis) {
      rows(i, axis) = points[static_cast<std::size_t>(i)][axis];
    }
  }
  return array;
}

py::dict readPcd(const std::string& path, int threads) {
  pcrb::DatasetCloud cloud;
  {
    const py::gil_scoped_release release;
    cloud = pcrb::readPcd(path, {threads});
  }
  py::dict result;
  result["points"] = toArray(cloud.points);
  result["intensity"] = py::none();
  if (!cloud.intensity.empty()) {
    result["intensity"] = py::array_t<float>(static_cast<py::ssize_t>(cloud.intensity.size()),
                                             cloud.intensity.data());
  }
  result["viewpoint"] = py::none();
  if (cloud.hasViewpoint()) {
    result["viewpoint"] = py::cast(Eigen::Matrix4d(cloud.viewpoint.matrix()));
  }
  result["dropped_non_finite"] = cloud.dropped_non_finite;
  return result;
}

void writePcd(const std::string& path, const Array& points, const Rows& viewpoint) {
  pcrb::DatasetCloud cloud = toCloud(points);
  cloud.viewpoint = pcrb::requireRigid(viewpoint);
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

py::list readProblems(const std::string& path) {
  py::list list;
  for (const pcrb::Problem& problem : pcrb::readProblemFile(path)) {
    py::dict row;
    row["id"] = textOf(problem.id);
    row["source"] = textOf(problem.source);
    row["target"] = textOf(problem.target);
    row["overlap"] = problem.overlap;
    Eigen::Matrix4d P = Eigen::Matrix4d::Identity();
    P.topRows<3>() = problem.perturbation;
    row["perturbation"] = py::cast(P);
    list.append(row);
  }
  return list;
}

void writeProblems(const std::string& path, const std::vector<py::dict>& rows) {
  std::vector<pcrb::Problem> problems;
  for (const py::dict& row : rows) {
    const auto P = row["perturbation"].cast<Eigen::Matrix4d>();
    problems.push_back({row["id"].cast<std::string>(), row["source"].cast<std::string>(),
                        row["target"].cast<std::string>(), row["overlap"].cast<double>(),
                        P.topRows<3>()});
  }
  pcrb::writeProblemFile(path, problems);
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
  return row;
}

py::list readResults(const std::string& folder) {
  const pcrb::ResultsStore store(folder, pcrb::ResultsStore::Access::kReadOnly);
  py::list list;
  for (const pcrb::Result& result : store.results()) list.append(toRow(result));
  return list;
}

py::list findSequences(const std::string& root) {
  py::list list;
  for (const pcrb::SequenceFiles& files : pcrb::findSequences(root)) {
    list.append(py::make_tuple(textOf(files.data_set), textOf(files.sequence), toString(files.kind),
                               textOf(files.problem_file)));
  }
  return list;
}

pcrb::ProblemSelection selectionOf(const std::string& root,
                                   const std::vector<std::string>& sequences,
                                   const std::vector<std::string>& kinds, std::size_t subset,
                                   std::uint64_t seed) {
  pcrb::ProblemSelection selection;
  selection.root = root;
  selection.sequences = sequences;
  selection.kinds.clear();
  for (const std::string& kind : kinds) selection.kinds.push_back(pcrb::kindFromString(kind));
  selection.subset = subset;
  selection.seed = seed;
  return selection;
}

/// The problems of a selection in the order of their files, with what a data set of them needs.
py::list plan(const std::string& root, const std::vector<std::string>& sequences,
              const std::vector<std::string>& kinds, std::size_t subset, std::uint64_t seed) {
  py::list list;
  const pcrb::RunPlan problems =
      pcrb::makeRunPlan(selectionOf(root, sequences, kinds, subset, seed));
  for (const pcrb::PlannedProblem& planned : problems.problems) {
    py::dict row;
    row["id"] = textOf(planned.key.problem_id);
    row["data_set"] = textOf(planned.key.data_set);
    row["sequence"] = textOf(planned.key.sequence);
    row["kind"] = toString(planned.key.kind);
    row["source"] = textOf(planned.problem.source);
    row["target"] = textOf(planned.problem.target);
    row["source_path"] = textOf(planned.source_path);
    row["target_path"] = textOf(planned.target_path);
    row["overlap"] = planned.problem.overlap;
    row["voxel_leaf"] = planned.data_set->voxel_leaf;
    row["perturbation"] = py::cast(Eigen::Matrix4d(planned.P.matrix()));
    list.append(row);
  }
  return list;
}

Eigen::Vector3d localOrigin(const Array& target) {
  return pcrb::chooseLocalOrigin(toCloud(target));
}

std::vector<std::size_t> selectSequences(
    const std::vector<std::pair<std::string, std::string>>& known,
    const std::vector<std::string>& words) {
  std::vector<pcrb::SequenceName> names;
  for (const auto& [data_set, sequence] : known) names.push_back({data_set, sequence});
  return pcrb::selectSequences(names, words, "among these");
}

py::object cloudArray(const std::vector<float>& coordinates) {
  const auto rows = static_cast<py::ssize_t>(coordinates.size() / 3);
  return py::array_t<float>(std::vector<py::ssize_t>{rows, 3}, coordinates.data());
}

py::object intensityArray(const std::vector<float>& values) {
  if (values.empty()) return py::none();
  return py::array_t<float>(static_cast<py::ssize_t>(values.size()), values.data());
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
  return py::object(fields);
}

pcrb::Submission poseSubmission(const Eigen::Vector3d& position, const Eigen::Vector4d& xyzw) {
  pcrb::Submission submission;
  submission.position = position;
  submission.orientation.coeffs() = xyzw;
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

py::dict readRunInfo(const std::string& folder) {
  const pcrb::ResultsStore store(folder, pcrb::ResultsStore::Access::kReadOnly);
  py::dict info;
  for (const auto& [key, value] : store.runInfo()) info[textOf(key)] = textOf(value);
  return info;
}

/// Raises a class of this module. A message may name a path of any bytes: Python's own escapes.
void raise(const char* name, const std::exception& error) {
  const py::object type = py::module::import("pcrb._pcrb").attr(name);
  const py::object text = textOf(error.what());
  PyErr_SetObject(type.ptr(), text.ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    std::rethrow_exception(std::move(thrown));
  } catch (const pcrb::InvalidFile& error) {
    raise("InvalidFile", error);
  } catch (const pcrb::InvalidProblem& error) {
    raise("InvalidProblem", error);
  } catch (const pcrb::InvalidParameter& error) {
    raise("InvalidParameter", error);
  } catch (const pcrb::StoreError& error) {
    raise("StoreError", error);
  } catch (const pcrb::Error& error) {
    raise("Error", error);
  }
}

}  // namespace

PYBIND11_MODULE(_pcrb, module) {
  const py::exception<pcrb::Error> base(module, "Error", PyExc_RuntimeError);
  const py::exception<pcrb::InvalidFile> invalid_file(module, "InvalidFile", base);
  const py::exception<pcrb::InvalidProblem> invalid_problem(module, "InvalidProblem", base);
  const py::exception<pcrb::InvalidParameter> invalid_parameter(module, "InvalidParameter", base);
  const py::exception<pcrb::StoreError> store_error(module, "StoreError", base);
  py::register_exception_translator(&translate);
  module.def("error", [](const Array& aligned, const Array& ground_truth) {
    return pcrb::error(toCloud(aligned).points, toCloud(ground_truth).points);
  });
  module.def("evaluate", &evaluate);
  module.def("read_pcd", &readPcd);
  module.def("write_pcd", &writePcd);
  module.def("read_problems", &readProblems);
  module.def("write_problems", &writeProblems);
  module.def("move", &moved);
  module.def("perturbation_about", &perturbationAbout);
  module.def("plan", &plan);
  module.def("local_origin", &localOrigin);
  defineRun(module);
  module.def("find_sequences", &findSequences);
  module.def("select_sequences", &selectSequences);
  module.def("methods", &pcrb::registrationMethods);
  module.def("read_results", &readResults);
  module.def("read_run_info", &readRunInfo);
}
