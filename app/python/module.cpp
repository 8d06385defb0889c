#include "python/module.h"

#include <pybind11/numpy.h>

#include "python/errors.h"
#include "python/pickling.h"

PYBIND11_MODULE(_core, module) {
  using namespace chainmail::python;  // NOLINT(google-build-using-namespace)
  module.doc() = "The compiled part of the package chainmail.";
  module.attr("__version__") = CHAINMAIL_VERSION;
  pybind11::dtype::of<double>();  // loads NumPy now: a thread that did so later could be ended in the middle of it
  translate_errors();
  add_types(module);  // first: others use them as defaults
  add_mesh(module);
  add_method(module);
  add_body(module);
  add_handle(module);
  add_deformer(module);
  add_mesh_file(module);
  add_measure(module);
  add_compare(module);
  add_calibrate(module);
  add_ramp(module);
  refuse_uninitialised(module);
  add_pickled_functions(module);
}
