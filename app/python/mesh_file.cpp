#include "chainmail/mesh_file.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "python/arrays.h"
#include "python/long_work.h"
#include "python/module.h"

namespace chainmail::python {
namespace {

api::Mesh read_mesh(const std::filesystem::path& path, const api::ReadOptions& options,
                    const std::optional<api::Job>& job, const py::object& progress) {
  const api::Job watched = job.value_or(api::Job());
  return run_long(watched, progress, [&] { return api::read_mesh(path, options, watched); });
}

void write_body(const std::filesystem::path& path, Object& object) {
  const UseObject use(object);
  const api::Job job;
  run_long(job, py::none(), [&] { api::write_mesh(path, object.body(), job); });
}

void write_rest(const std::filesystem::path& path, const api::Mesh& mesh) {
  const api::Job job;
  run_long(job, py::none(), [&] { api::write_mesh(path, mesh, job); });
}

py::list rows_of_formats() {
  py::list rows;
  for (const api::FileFormat& format : api::file_formats()) {
    py::dict row;
    row["name"] = format.name;
    row["endings"] = py::str(format.endings).attr("split")();
    row["content"] = format.content;
    row["reads"] = format.reads;
    row["writes"] = format.writes;
    row["holds_positions"] = format.holds_positions;
    rows.append(row);
  }
  return rows;
}

}  // namespace

void add_mesh_file(py::module_& module) {
  module.def(
      "read_mesh",
      [](const std::filesystem::path& path, const std::optional<std::array<std::uint32_t, 3>>& lattice,
         std::optional<double> spacing, std::optional<int> space_dimension, std::optional<double> threshold,
         std::optional<std::uint32_t> every, bool data_outside, bool stiff_where_dense, std::optional<double> weld,
         const std::string& import_program, const std::optional<api::Job>& job, const py::object& progress) {
        return read_mesh(path,
                         {lattice, spacing, space_dimension, threshold, every, data_outside, import_program,
                          stiff_where_dense, weld},
                         job, progress);
      },
      py::arg("path"), py::kw_only(), py::arg("lattice") = py::none(), py::arg("spacing") = py::none(),
      py::arg("space_dimension") = py::none(), py::arg("threshold") = py::none(), py::arg("every") = py::none(),
      py::arg("data_outside") = false, py::arg("stiff_where_dense") = true, py::arg("weld") = py::none(),
      py::arg("import_program") = "", py::arg("job") = py::none(), py::arg("progress") = py::none(),
      "Reads a mesh; chainmail.read_mesh() also finds the import program.");
  module.def(
      "write_mesh", &write_body, py::arg("path"), py::arg("body"),
      "Writes an object with its cuts at its current positions, in the format of the file's ending: faces, cells\n"
      "and links (.obj, .ply, .vtu, .msh, .dat), or a table `id,x,y,z` of positions (.csv). A mesh is written at\n"
      "rest. If writing fails, the old file stays. Raises Error if the format is not known or cannot store the\n"
      "object, or if the file cannot be written.");
  module.def("write_mesh", &write_rest, py::arg("path"), py::arg("mesh"));
  module.def(
      "file_formats", &rows_of_formats,
      "Returns all formats of files, a dictionary each: name, endings (the first one is used for writing), content,\n"
      "reads, writes, and holds_positions (False if it stores links only).");
}

}  // namespace chainmail::python
