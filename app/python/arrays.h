#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "chainmail/error.h"
#include "chainmail/mesh.h"
#include "chainmail/types.h"

namespace chainmail::python {

namespace py = pybind11;

// What Python passes, as what C++ takes. These functions throw api::Error with a sentence for a wrong shape, a wrong
// type of numbers and a number that is no id; TypeError for something else than numbers.

/// Returns a whole number; nothing if it is beyond 64 bits. Throws TypeError for something else.
std::optional<std::int64_t> whole_of(py::handle value);
/// Returns an id. `what` is the word in errors: element or link.
std::uint32_t id_of(py::handle value, const char* what);
/// Returns ids from a sequence or a one-dimensional array of whole numbers, or from a single number.
std::vector<std::uint32_t> ids_of(py::handle values, const char* what);
/// Returns an array of shape (rows, columns) of ids as one row after the other; None is empty.
std::vector<std::uint32_t> rows_of(py::handle values, const std::string& name, std::size_t columns);

/// Returns 1 to 3 coordinates as a vector; those that are missing are 0.
api::Vector3 vector_of(py::handle value, const char* where);
/// Returns an array of shape (elements, 1 to 3) as x, y and z for each element; coordinates that are missing are 0.
std::vector<double> positions_of(py::handle values);
/// The same for the elements of a mesh: an array of shape (elements, 3), or with a column for each axis that exists.
std::vector<double> positions_on(const api::Mesh& mesh, py::handle values);
/// Returns a number, or one for each of `count` links. `name` is that of the argument.
std::vector<double> numbers_of(py::handle value, const std::string& name, std::size_t count);

/// Returns the next object of an iterator; nothing after the last one. Throws what Python raises, also for Ctrl-C.
py::object next_of(const py::object& iterator);
/// Returns a short list. `name` is that of the argument.
template <class Value>
std::vector<Value> list_of(const py::sequence& values, const std::string& name) {
  constexpr std::size_t most = 10'000;
  if (values.size() > most) {
    throw api::Error(name, "it has " + std::to_string(values.size()) + " entries",
                     "give at most " + std::to_string(most));
  }
  py::detail::make_caster<std::vector<Value>> list;
  if (!list.load(values, true)) {
    throw py::type_error(name + " has an entry of a wrong type");
  }
  return py::detail::cast_op<std::vector<Value>>(std::move(list));
}

/// Returns the position of a word in a list. Throws Error, with all words, if it is not in it.
std::size_t word_of(const std::string& name, std::string_view word, std::span<const std::string_view> words);

py::tuple tuple_of(const api::Vector3& vector);
py::array_t<std::uint32_t> array_of(std::span<const std::uint32_t> ids);
/// Returns an array of shape (numbers / columns, columns).
py::array_t<double> array_of(std::span<const double> numbers, std::size_t columns);

}  // namespace chainmail::python
