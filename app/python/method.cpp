#include "chainmail/method.h"

#include <pybind11/stl.h>

#include "python/module.h"

namespace chainmail::python {
namespace {

py::dict named(const api::MethodInfo& info) {
  py::dict facts;
  facts["name"] = info.name;
  facts["label"] = info.label;
  facts["source"] = info.source;
  facts["summary"] = info.summary;
  facts["family"] = info.family == api::MethodFamily::chainmail ? "chainmail" : "elastic";
  facts["needs_grid"] = info.needs_grid;
  facts["needs_pins"] = info.needs_pins;
  facts["holds_links"] = info.holds_links;
  return facts;
}

py::list rows_of_methods() {
  py::list rows;
  for (const api::MethodInfo& info : api::methods()) {
    rows.append(named(info));
  }
  return rows;
}

}  // namespace

void add_method(py::module_& module) {
  module.def(
      "methods", &rows_of_methods,
      "Returns all methods, a dictionary each: name, label, source (publication), summary, family (`chainmail` or\n"
      "`elastic`), needs_grid, needs_pins and holds_links (True if no link is violated after a move).");
  module.def(
      "refusal", [](const std::string& method, const api::Mesh& mesh) { return api::refusal(method, mesh); },
      py::arg("method"), py::arg("mesh"),
      "Returns the reason why a method does not work on a mesh, in one sentence; empty if it does. Raises Error for\n"
      "an unknown name.");
}

}  // namespace chainmail::python
