#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "body/softness.h"
#include "python/object.h"

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
std::vector<std::uint32_t> rows_of(py::handle values, const std::string& name, std::size_t columns);

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
/// Returns an array of shape (numbers / columns, columns).
py::array_t<double> array_of(std::span<const double> numbers, std::size_t columns);

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

// Enumerations are words in Python, in the order of their constants.

using Words = std::vector<std::string_view>;
const Words& words(Precision);
const Words& words(RelaxationScheme);
const Words& words(EnergyKind);
const Words& words(StrainLaw::Kind);
/// Returns the index of a word in a list. Throws Error, with all words, if it is not in it.
std::size_t index_of(const std::string& name, std::string_view word, const Words& words);
/// Returns the constant of a word. `name` is that of the argument.
template <class Kind>
Kind named(const std::string& name, std::string_view word) {
  return static_cast<Kind>(index_of(name, word, words(Kind{})));
}
template <class Kind>
std::string_view word_for(Kind kind) {
  return words(kind)[std::size_t(kind)];
}

/// A table as a dictionary of columns: a list for each name, all of one length. pandas.DataFrame takes it as it is.
class Table {
 public:
  template <class Value>
  void put(const char* column, const Value& value) {
    if (!columns_.contains(column)) {
      columns_[column] = py::list();
    }
    columns_[column].cast<py::list>().append(py::cast(value));
  }
  const py::dict& columns() const { return columns_; }

 private:
  py::dict columns_;
};

/// Returns a dictionary of named numbers.
py::dict dict_of(std::initializer_list<std::pair<const char*, double>> numbers);

}  // namespace chainmail::python
