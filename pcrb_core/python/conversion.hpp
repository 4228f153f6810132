#pragma once

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "pcrb_core/point_cloud.hpp"
#include "pcrb_core/run/run_plan.hpp"

/// What Python has, and what the core has.
namespace pcrb_python {

namespace py = pybind11;

using Array = py::array_t<double, py::array::c_style>;  ///< (n, 3)
using Rows = Eigen::Matrix<double, 3, 4>;               ///< of a rigid transform, the upper three

/// A text of any bytes, as a name of a file may be, as Python has it: with its own escapes.
py::object textOf(const std::string& bytes);

/// @throws InvalidProblem  where a point is not finite.
pcrb::DatasetCloud toCloud(const Array& array);

Array toArray(const std::vector<Eigen::Vector3d>& points);

/// None for no values.
py::object intensityArray(const std::vector<float>& values);

pcrb::ProblemSelection selectionOf(const std::string& root,
                                   const std::vector<std::string>& sequences,
                                   const std::vector<std::string>& kinds, std::size_t subset,
                                   std::uint64_t seed);

/// The parts of the module; each defines its functions.
void defineClouds(py::module& module);
void defineProblems(py::module& module);
void defineRuns(py::module& module);

}  // namespace pcrb_python
