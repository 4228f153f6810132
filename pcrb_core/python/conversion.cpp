#include "conversion.hpp"

#include <string>
#include <vector>

#include "pcrb_core/error.hpp"
#include "pcrb_core/problem/dataset.hpp"

namespace pcrb_python {

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

py::object intensityArray(const std::vector<float>& values) {
  if (values.empty()) return py::none();
  return py::array_t<float>(static_cast<py::ssize_t>(values.size()), values.data());
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

}  // namespace pcrb_python
