// The extension module pcrb._pcrb: C++ functions as they are. What users see, with names, checks
// and docstrings, is pcrb/__init__.py.

#include <exception>
#include <string>
#include <utility>

#include "conversion.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/registration/registration.hpp"
#include "pcrb_core/run/results_store.hpp"

namespace pcrb_python {

namespace {

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
}  // namespace pcrb_python

PYBIND11_MODULE(_pcrb, module) {
  namespace py = pybind11;
  const py::exception<pcrb::Error> base(module, "Error", PyExc_RuntimeError);
  const py::exception<pcrb::InvalidFile> invalid_file(module, "InvalidFile", base.ptr());
  const py::exception<pcrb::InvalidProblem> invalid_problem(module, "InvalidProblem", base.ptr());
  const py::exception<pcrb::InvalidParameter> invalid_parameter(module, "InvalidParameter",
                                                                base.ptr());
  const py::exception<pcrb::StoreError> store_error(module, "StoreError", base.ptr());
  py::register_exception_translator(&pcrb_python::translate);
  pcrb_python::defineClouds(module);
  pcrb_python::defineProblems(module);
  pcrb_python::defineRuns(module);
  module.def("methods", &pcrb::registrationMethods);
}
