#include "python/errors.h"

#include <exception>
#include <utility>

#include "chainmail/error.h"

namespace chainmail::python {
namespace {

namespace py = pybind11;

py::object class_of(const char* name) { return py::module_::import("chainmail.errors").attr(name); }

/// Sets chainmail.Error as the exception of Python.
void set_error(const api::Error& error) {
  const py::object type = class_of("Error");
  const py::object value = type(error.where(), error.problem(), error.remedy());
  PyErr_SetObject(type.ptr(), value.ptr());
}

void set_cancelled() { PyErr_SetString(class_of("Cancelled").ptr(), "cancelled"); }

}  // namespace

void translate_errors() {
  py::register_exception_translator([](std::exception_ptr raised) {
    try {
      std::rethrow_exception(std::move(raised));
    } catch (const api::Error& error) {
      set_error(error);
    } catch (const api::Cancelled&) {
      set_cancelled();
    }
  });
}

}  // namespace chainmail::python
