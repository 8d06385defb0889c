#include "python/arrays.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <span>
#include <utility>

#include "python/long_work.h"

namespace chainmail::python {
namespace {

constexpr std::uint32_t max_ids = std::numeric_limits<std::uint32_t>::max();
/// Most rows of an array. A mesh has about seven links or six cells for each element.
constexpr std::size_t most_rows = 10 * std::size_t{element_limit};
constexpr py::ssize_t rows_between_looks = 1 << 18;  // copied in a few ms

template <class Whole>
std::uint32_t checked_id(Whole id, const char* what) {
  if (std::cmp_less(id, 0) || std::cmp_greater_equal(id, max_ids)) {
    throw Error(std::string(what) + " " + std::to_string(id), std::string("there is no such ") + what,
                "use a number from 0");
  }
  return static_cast<std::uint32_t>(id);
}

/// An array that Python passes. What NumPy raises, such as MemoryError, is thrown.
class Given {
 public:
  /// Lists whose rows differ in length become arrays of objects. Throws Error for more than `most` rows, before memory
  /// is taken.
  Given(py::handle values, std::string name, std::size_t most = most_rows)
      : name_(std::move(name)), array_(array_from(values, most)) {}

  py::ssize_t dimensions() const { return array_.ndim(); }
  py::ssize_t size() const { return array_.size(); }
  py::ssize_t rows() const { return array_.ndim() == 0 ? 1 : array_.shape(0); }
  py::ssize_t columns() const { return array_.ndim() == 2 ? array_.shape(1) : 0; }

  void check_shape(bool is_right, const std::string& remedy) const {
    if (!is_right) {
      throw Error(name_, "the array has the shape " + std::string(py::str(array_.attr("shape"))), remedy);
    }
  }

  std::vector<double> reals() const {
    check_type(is_whole() || kind() == 'f', "give real numbers, such as dtype float64");
    std::vector<double> numbers;
    numbers.reserve(std::size_t(size()));
    take_in_parts<double>([&](auto part) { numbers.insert(numbers.end(), part.begin(), part.end()); });
    return numbers;
  }

  std::vector<std::uint32_t> ids(const char* what) const {
    check_type(is_whole(), "give whole numbers, such as dtype uint32");
    std::vector<std::uint32_t> ids;
    ids.reserve(std::size_t(size()));
    const auto take = [&](auto part) {
      std::ranges::transform(part, std::back_inserter(ids), [&](auto id) { return checked_id(id, what); });
    };
    if (kind() == 'u') {
      take_in_parts<std::uint64_t>(take);
    } else {
      take_in_parts<std::int64_t>(take);
    }
    return ids;
  }

 private:
  py::array array_from(py::handle values, std::size_t most) const {
    if (const std::size_t rows = py::len_hint(values); rows > most) {
      throw Error(name_, "it has " + std::to_string(rows) + " rows", "give at most " + std::to_string(most));
    }
    try {
      return py::array(py::reinterpret_borrow<py::object>(values));
    } catch (const py::error_already_set& error) {
      if (!error.matches(PyExc_ValueError) && !error.matches(PyExc_TypeError)) {
        throw;
      }
    }
    throw Error(name_, "it is not an array of numbers", "give a NumPy array or nested lists of equal length");
  }

  char kind() const { return array_.dtype().kind(); }
  bool is_whole() const { return kind() == 'i' || kind() == 'u'; }
  void check_type(bool is_right, const char* remedy) const {
    if (size() > 0 && !is_right) {
      throw Error(name_, "the numbers are of type " + std::string(py::str(py::object(array_.dtype()))), remedy);
    }
  }

  /// Calls `take` with the numbers as spans, a part of the rows at a time: a copy takes little memory, and Ctrl-C ends
  /// it.
  template <class Number, class Take>
  void take_in_parts(Take take) const {
    for (py::ssize_t row = 0; row < rows(); row += rows_between_looks) {
      const py::array part =
          rows() <= rows_between_looks ? array_ : py::array(array_[py::slice(row, row + rows_between_looks, 1)]);
      const py::array_t<Number, py::array::c_style | py::array::forcecast> flat(part);
      take(std::span<const Number>(flat.data(), std::size_t(flat.size())));
      if (PyErr_CheckSignals() != 0) {
        throw py::error_already_set();
      }
    }
  }

  std::string name_;
  py::array array_;
};

/// Returns x, y and z for each row. Fewer than three columns are `axes`, and the other coordinates are `origin`.
std::vector<double> spread_out(const Given& array, const std::array<int, 3>& axes, const Point& origin) {
  std::vector<double> numbers = array.reals();
  const auto columns = std::size_t(array.columns()), rows = std::size_t(array.rows());
  if (columns == 3) {
    return numbers;
  }
  std::vector<double> positions(3 * rows);
  for (std::size_t row = 0; row < rows; ++row) {
    double* at = positions.data() + 3 * row;
    std::ranges::copy(origin, at);
    for (std::size_t k = 0; k < columns; ++k) {
      at[std::size_t(axes[k])] = numbers[row * columns + k];
    }
  }
  return positions;
}

double number_of(PyObject* value) {
  const double number = PyFloat_CheckExact(value) ? PyFloat_AS_DOUBLE(value) : PyFloat_AsDouble(value);
  if (number == -1 && PyErr_Occurred() != nullptr) {
    throw py::error_already_set();
  }
  return number;
}

}  // namespace

std::optional<std::int64_t> whole_of(py::handle value) {
  const py::object index = PyLong_CheckExact(value.ptr())
                               ? py::reinterpret_borrow<py::object>(value)
                               : py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
  if (!index) {
    throw py::error_already_set();
  }
  int overflow = 0;
  const long long number = PyLong_AsLongLongAndOverflow(index.ptr(), &overflow);
  return overflow == 0 ? std::optional<std::int64_t>(number) : std::nullopt;
}

std::uint32_t id_of(py::handle value, const char* what) {
  const auto id = whole_of(value);
  if (!id) {
    throw Error(std::string(what) + " " + std::string(py::repr(value)).substr(0, 60),
                std::string("there is no such ") + what, "use a number from 0");
  }
  return checked_id(*id, what);
}

std::vector<std::uint32_t> ids_of(py::handle values, const char* what) {
  if (PyLong_Check(values.ptr())) {
    return {id_of(values, what)};
  }
  const Given array(values, std::string(what) + "s");
  array.check_shape(array.dimensions() <= 1, "give one dimension");
  return array.ids(what);
}

std::vector<std::uint32_t> rows_of(py::handle values, const char* name, py::ssize_t columns) {
  if (values.is_none()) {
    return {};
  }
  const Given array(values, name);
  array.check_shape(array.size() == 0 || array.columns() == columns,
                    "give the shape (n, " + std::to_string(columns) + ")");
  return array.ids("element");
}

py::object next_of(const py::object& iterator) {
  auto item = py::reinterpret_steal<py::object>(outlive_python([&] { return PyIter_Next(iterator.ptr()); }));
  if (PyErr_CheckSignals() != 0 || (!item && PyErr_Occurred() != nullptr)) {
    throw py::error_already_set();
  }
  return item;
}

Point vector_of(py::handle value, const char* where) {
  std::array<double, 3> at{};
  const auto items = py::reinterpret_steal<py::object>(PyObject_GetIter(value.ptr()));
  if (!items) {
    PyErr_Clear();
    throw py::type_error(std::string(where) + " must be a sequence of numbers: x, y, z");
  }
  std::size_t count = 0;
  while (const py::object item = next_of(items)) {
    if (count == at.size()) {
      throw Error(where, "it has more than 3 numbers", "give x, y and z; those left out are 0");
    }
    at[count++] = number_of(item.ptr());
  }
  if (count == 0) {
    throw Error(where, "it has no numbers", "give x, y and z; those left out are 0");
  }
  return {at[0], at[1], at[2]};
}

std::vector<double> positions_of(py::handle values) {
  const Given array(values, "positions", element_limit);
  array.check_shape(array.columns() >= 1 && array.columns() <= 3,
                    "give the shape (n, 3): x, y and z for each of n elements; or (n, 2) or (n, 1)");
  return spread_out(array, {0, 1, 2}, Point::Zero());
}

std::vector<double> positions_on(const Mesh& mesh, py::handle values) {
  const Given array(values, "positions", element_limit);
  const std::string count = "(" + std::to_string(mesh.element_count()) + ", ";
  const bool has_columns = array.columns() == 3 || array.columns() == mesh.space_dimension;
  array.check_shape(array.rows() == py::ssize_t(mesh.element_count()) && has_columns,
                    "give the shape " + count + "3)" +
                        (mesh.space_dimension == 3 ? "" : " or " + count + std::to_string(mesh.space_dimension) + ")"));
  return spread_out(array, mesh.axes, mesh.origin);
}

std::vector<double> numbers_of(py::handle value, const std::string& name, std::size_t count) {
  const Given array(value, name);
  const bool is_one = array.dimensions() == 0;
  array.check_shape(is_one || (array.dimensions() == 1 && std::size_t(array.rows()) == count),
                    "give one number, or the shape (" + std::to_string(count) + ",)");
  std::vector<double> numbers = array.reals();
  return is_one ? std::vector<double>(count, numbers.front()) : numbers;
}

py::tuple tuple_of(const Point& vector) { return py::make_tuple(vector.x(), vector.y(), vector.z()); }

py::array_t<std::uint32_t> array_of(std::span<const std::uint32_t> ids) {
  return py::array_t<std::uint32_t>(py::ssize_t(ids.size()), ids.data());
}

}  // namespace chainmail::python
