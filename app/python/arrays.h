#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "body/positions.h"
#include "mesh/error.h"

namespace chainmail::python {

namespace py = pybind11;

// What Python passes, as what C++ takes. These functions throw Error with a sentence for a wrong shape, a wrong
// type of numbers and a number that is no id; TypeError for something else than numbers.

/// Returns a whole number; nothing if it is beyond 64 bits. Throws TypeError for something else.
std::optional<std::int64_t> whole_of(py::handle value);
/// Returns an id. `what` is the word in errors: element or link.
std::uint32_t id_of(py::handle value, const char* what);
/// Returns ids from a sequence or a one-dimensional array of whole numbers, or from a single number.
std::vector<std::uint32_t> ids_of(py::handle values, const char* what);
/// Returns an array of shape (rows, columns) of ids as one row after the other; None is empty.
std::vector<std::uint32_t> rows_of(py::handle values, const char* name, py::ssize_t columns);

/// Returns 1 to 3 coordinates as a vector; those that are missing are 0.
Point vector_of(py::handle value, const char* where);
/// Returns an array of shape (elements, 1 to 3) as x, y and z for each element; coordinates that are missing are 0.
std::vector<double> positions_of(py::handle values);
/// The same for the elements of a mesh: an array of shape (elements, 3), or with a column for each axis that exists.
std::vector<double> positions_on(const Mesh& mesh, py::handle values);
/// Returns a number, or one for each of `count` links. `name` is that of the argument.
std::vector<double> numbers_of(py::handle value, const std::string& name, std::size_t count);

/// Returns the next object of an iterator; nothing after the last one. Throws what Python raises, also for Ctrl-C.
py::object next_of(const py::object& iterator);
/// Returns a short list. `name` is that of the argument.
template <class Value>
std::vector<Value> list_of(const py::sequence& values, const std::string& name) {
  constexpr std::size_t most = 10'000;
  if (values.size() > most) {
    throw Error(name, "it has " + std::to_string(values.size()) + " entries", "give at most " + std::to_string(most));
  }
  py::detail::make_caster<std::vector<Value>> list;
  if (!list.load(values, true)) {
    throw py::type_error(name + " has an entry of a wrong type");
  }
  return py::detail::cast_op<std::vector<Value>>(std::move(list));
}

py::tuple tuple_of(const Point& vector);
py::array_t<std::uint32_t> array_of(std::span<const std::uint32_t> ids);

/// Writes x, y and z of each element of a mesh, which `point_of` returns.
template <class PointOf>
void write_points(const Mesh& mesh, double* out, PointOf point_of) {
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    Eigen::Map<Point>(out + std::size_t{3} * e) = point_of(e);
  }
}
/// Returns them as an array of shape (element_count, 3).
template <class PointOf>
py::array_t<double> array_of_points(const Mesh& mesh, PointOf point_of) {
  py::array_t<double> points({py::ssize_t(mesh.element_count()), py::ssize_t(3)});
  write_points(mesh, points.mutable_data(), point_of);
  return points;
}

/// Returns an array of shape (rows, columns) that shows numbers of an owner, which Python must not write. `owner` keeps
/// them alive. Bytes lie between the starts of two rows.
template <class Number>
py::array shown(const Number* first, std::size_t rows, std::size_t columns, std::size_t row_bytes,
                const py::capsule& owner) {
  py::array array(py::dtype::of<Number>(), {py::ssize_t(rows), py::ssize_t(columns)},
                  {py::ssize_t(row_bytes), py::ssize_t(sizeof(Number))}, first, owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}
/// Returns a capsule that keeps a value as long as an array shows it.
template <class Value, class... Arguments>
py::capsule kept(Arguments&&... arguments) {
  return py::capsule(new Value(std::forward<Arguments>(arguments)...),
                     [](void* value) { delete static_cast<Value*>(value); });
}

}  // namespace chainmail::python
