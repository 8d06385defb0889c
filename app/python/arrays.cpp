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

std::string shape_in_words(const py::array& array) {
  std::string words = "(";
  for (py::ssize_t k = 0; k < array.ndim(); ++k) {
    words += (k == 0 ? "" : ", ") + std::to_string(array.shape(k));
  }
  return words + (array.ndim() == 1 ? ",)" : ")");
}

/// Returns numbers as an array. Lists whose rows differ in length become arrays of objects. What else NumPy raises,
/// such as MemoryError, is thrown. Throws Error for more than `most` rows, before memory is taken.
py::array array_from(py::handle values, const std::string& name, std::size_t most = most_rows) {
  if (const std::size_t rows = py::len_hint(values); rows > most) {
    throw Error(name, "it has " + std::to_string(rows) + " rows", "give at most " + std::to_string(most));
  }
  try {
    return py::array(py::reinterpret_borrow<py::object>(values));
  } catch (const py::error_already_set& error) {
    if (!error.matches(PyExc_ValueError) && !error.matches(PyExc_TypeError)) {
      throw;
    }
  }
  throw Error(name, "it is not an array of numbers", "give a NumPy array or nested lists of equal length");
}

std::string type_in_words(const py::array& array) { return py::str(py::object(array.dtype())); }

bool is_whole(const py::array& array) { return array.dtype().kind() == 'i' || array.dtype().kind() == 'u'; }
bool is_number(const py::array& array) { return array.dtype().kind() == 'f' || is_whole(array); }

/// Calls `take` with the numbers of an array as spans, a part of the rows at a time: a copy takes little memory, and
/// Ctrl-C ends it. What NumPy raises is thrown.
template <class Number, class Take>
void take_in_parts(const py::array& array, Take take) {
  const py::ssize_t rows = array.ndim() == 0 ? 1 : array.shape(0);
  for (py::ssize_t row = 0; row < rows; row += rows_between_looks) {
    const py::array part =
        rows <= rows_between_looks ? array : py::array(array[py::slice(row, row + rows_between_looks, 1)]);
    const py::array_t<Number, py::array::c_style | py::array::forcecast> flat(part);
    take(std::span<const Number>(flat.data(), std::size_t(flat.size())));
    if (PyErr_CheckSignals() != 0) {
      throw py::error_already_set();
    }
  }
}

void check_whole(const py::array& array, const std::string& name) {
  if (array.size() > 0 && !is_whole(array)) {
    throw Error(name, "the numbers are of type " + type_in_words(array), "give whole numbers, such as dtype uint32");
  }
}

std::vector<double> real_numbers(const py::array& array, const std::string& name) {
  if (array.size() > 0 && !is_number(array)) {
    throw Error(name, "the numbers are of type " + type_in_words(array), "give real numbers, such as dtype float64");
  }
  std::vector<double> numbers;
  numbers.reserve(std::size_t(array.size()));
  take_in_parts<double>(array,
                        [&](std::span<const double> part) { numbers.insert(numbers.end(), part.begin(), part.end()); });
  return numbers;
}

template <class Whole>
std::uint32_t checked_id(Whole id, const char* what) {
  if (std::cmp_less(id, 0) || std::cmp_greater_equal(id, max_ids)) {
    throw Error(std::string(what) + " " + std::to_string(id), std::string("there is no such ") + what,
                "use a number from 0");
  }
  return static_cast<std::uint32_t>(id);
}

std::vector<std::uint32_t> checked_ids(const py::array& array, const std::string& name, const char* what) {
  check_whole(array, name);
  std::vector<std::uint32_t> ids;
  ids.reserve(std::size_t(array.size()));
  const auto take = [&](const auto part) {
    std::ranges::transform(part, std::back_inserter(ids), [&](auto id) { return checked_id(id, what); });
  };
  if (array.dtype().kind() == 'u') {
    take_in_parts<std::uint64_t>(array, take);
  } else {
    take_in_parts<std::int64_t>(array, take);
  }
  return ids;
}

/// Returns x, y and z for each row. Fewer than three columns are `axes`, and the other coordinates are `origin`.
std::vector<double> spread_out(const py::array& array, const std::array<int, 3>& axes, const Point& origin) {
  std::vector<double> numbers = real_numbers(array, "positions");
  const auto columns = std::size_t(array.shape(1));
  if (columns == 3) {
    return numbers;
  }
  const auto rows = std::size_t(array.shape(0));
  std::vector<double> positions(3 * rows);
  const double* in = numbers.data();
  for (std::size_t row = 0; row < rows; ++row) {
    double* at = positions.data() + 3 * row;
    std::ranges::copy(origin, at);
    for (std::size_t k = 0; k < columns; ++k) {
      at[std::size_t(axes[k])] = *in++;
    }
  }
  return positions;
}

template <class Rows>
Words names_in(const Rows& rows) {
  Words names;
  std::ranges::transform(rows, std::back_inserter(names), [](const auto& row) { return row.name; });
  return names;
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
  const std::string name = std::string(what) + "s";
  const py::array array = array_from(values, name);
  if (array.ndim() > 1) {
    throw Error(name, "the array has the shape " + shape_in_words(array), "give one dimension");
  }
  return checked_ids(array, name, what);
}

std::vector<std::uint32_t> rows_of(py::handle values, const std::string& name, std::size_t columns) {
  if (values.is_none()) {
    return {};
  }
  const py::array array = array_from(values, name);
  if (array.size() == 0) {
    return {};
  }
  if (array.ndim() != 2 || std::size_t(array.shape(1)) != columns) {
    throw Error(name, "the array has the shape " + shape_in_words(array),
                "give the shape (n, " + std::to_string(columns) + ")");
  }
  return checked_ids(array, name, "element");
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
  const py::array array = array_from(values, "positions", element_limit);
  if (array.ndim() != 2 || array.shape(1) < 1 || array.shape(1) > 3) {
    throw Error("positions", "the array has the shape " + shape_in_words(array),
                "give the shape (n, 3): x, y and z for each of n elements; or (n, 2) or (n, 1)");
  }
  return spread_out(array, {0, 1, 2}, Point::Zero());
}

std::vector<double> positions_on(const Mesh& mesh, py::handle values) {
  const py::array array = array_from(values, "positions", element_limit);
  const std::string count = std::to_string(mesh.element_count());
  const bool fits = array.ndim() == 2 && array.shape(0) == py::ssize_t(mesh.element_count()) &&
                    (array.shape(1) == 3 || array.shape(1) == mesh.space_dimension);
  if (!fits) {
    const std::string flat = "(" + count + ", " + std::to_string(mesh.space_dimension) + ")";
    throw Error("positions", "the array has the shape " + shape_in_words(array),
                "give the shape (" + count + ", 3)" + (mesh.space_dimension == 3 ? "" : " or " + flat));
  }
  return spread_out(array, mesh.axes, mesh.origin);
}

std::vector<double> numbers_of(py::handle value, const std::string& name, std::size_t count) {
  const py::array array = array_from(value, name);
  if (array.ndim() > 1 || (array.ndim() == 1 && std::size_t(array.shape(0)) != count)) {
    throw Error(name, "the array has the shape " + shape_in_words(array),
                "give one number, or the shape (" + std::to_string(count) + ",)");
  }
  std::vector<double> numbers = real_numbers(array, name);
  return array.ndim() == 0 ? std::vector<double>(count, numbers.front()) : numbers;
}

py::tuple tuple_of(const Point& vector) { return py::make_tuple(vector.x(), vector.y(), vector.z()); }

py::array_t<std::uint32_t> array_of(std::span<const std::uint32_t> ids) {
  return py::array_t<std::uint32_t>(py::ssize_t(ids.size()), ids.data());
}

py::array_t<double> array_of(std::span<const double> numbers, std::size_t columns) {
  return py::array_t<double>({py::ssize_t(numbers.size() / columns), py::ssize_t(columns)}, numbers.data());
}

const Words& words(Precision /*kind*/) {
  static const Words all{"float", "double"};
  return all;
}

const Words& words(RelaxationScheme /*kind*/) {
  static const Words all = names_in(relaxation_schemes);
  return all;
}

const Words& words(EnergyKind /*kind*/) {
  static const Words all = names_in(energy_kinds());
  return all;
}

const Words& words(StrainLaw::Kind /*kind*/) {
  static const Words all{"neo-hookean", "gent", "fung"};
  return all;
}

std::size_t index_of(const std::string& name, std::string_view word, const Words& words) {
  const auto found = std::ranges::find(words, word);
  if (found == words.end()) {
    std::string list;
    for (std::size_t i = 0; i < words.size(); ++i) {
      list += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + std::string(words[i]);
    }
    throw Error(name + " '" + std::string(word.substr(0, 60)) + "'", "there is no such value", "use " + list);
  }
  return std::size_t(found - words.begin());
}

py::dict dict_of(std::initializer_list<std::pair<const char*, double>> numbers) {
  py::dict result;
  for (const auto& [name, number] : numbers) {
    result[name] = number;
  }
  return result;
}

}  // namespace chainmail::python
