#include "python/module.h"

#include <pybind11/numpy.h>

#include <exception>
#include <utility>

#include "python/pickling.h"

namespace chainmail::python {
namespace {

py::object class_of(const char* name) { return py::module_::import("chainmail.errors").attr(name); }

/// Makes the exceptions of core those of the module: Error becomes chainmail.Error, Cancelled becomes
/// chainmail.Cancelled.
void translate_errors() {
  py::register_exception_translator([](std::exception_ptr raised) {
    try {
      std::rethrow_exception(std::move(raised));
    } catch (const Error& error) {
      const py::object type = class_of("Error");
      const py::object value = type(error.where(), error.problem(), error.remedy());
      PyErr_SetObject(type.ptr(), value.ptr());
    } catch (const Cancelled&) {
      PyErr_SetString(class_of("Cancelled").ptr(), "cancelled");
    }
  });
}

}  // namespace
}  // namespace chainmail::python

PYBIND11_MODULE(_core, module) {
  using namespace chainmail::python;  // NOLINT(google-build-using-namespace)
  module.doc() = "The compiled part of the package chainmail.";
  module.attr("__version__") = CHAINMAIL_VERSION;
  pybind11::dtype::of<double>();  // loads NumPy now: a thread that did so later could be ended in the middle of it
  translate_errors();
  add_values(module);  // first: others use them as defaults
  add_mesh(module);
  add_body(module);
  add_deformer(module);
  add_measure(module);
  add_reports(module);
  refuse_uninitialised(module);
  add_pickled_functions(module);
}
