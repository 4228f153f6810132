#include <string>
#include <utility>
#include <vector>

#include "conversion.hpp"
#include "pcrb_core/problem/dataset.hpp"
#include "pcrb_core/problem/problem.hpp"
#include "pcrb_core/run/run_plan.hpp"

namespace pcrb_python {
namespace {

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

py::list findSequences(const std::string& root) {
  py::list list;
  for (const pcrb::SequenceFiles& files : pcrb::findSequences(root)) {
    list.append(py::make_tuple(textOf(files.data_set), textOf(files.sequence), toString(files.kind),
                               textOf(files.problem_file)));
  }
  return list;
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

std::vector<std::size_t> selectSequences(
    const std::vector<std::pair<std::string, std::string>>& known,
    const std::vector<std::string>& words) {
  std::vector<pcrb::SequenceName> names;
  for (const auto& [data_set, sequence] : known) names.push_back({data_set, sequence});
  return pcrb::selectSequences(names, words, "among these");
}

}  // namespace

void defineProblems(py::module& module) {
  module.def("read_problems", &readProblems);
  module.def("write_problems", &writeProblems);
  module.def("plan", &plan);
  module.def("find_sequences", &findSequences);
  module.def("select_sequences", &selectSequences);
}

}  // namespace pcrb_python
