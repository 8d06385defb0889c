// Positions as arrays: copies, and views of what the solver stores.
#include <pybind11/stl.h>

#include <algorithm>

#include "chainmail/error.h"
#include "python/arrays.h"
#include "python/module.h"
#include "python/unlocked.h"

namespace chainmail::python {
namespace {

using api::Error;

constexpr py::ssize_t all_columns = 3;

/// Keeps an object alive as long as an array shows its positions.
struct Lease {
  explicit Lease(ObjectPointer shown) : object(std::move(shown)) { object->add_view(); }
  Lease(const Lease&) = delete;
  Lease& operator=(const Lease&) = delete;
  ~Lease() { object->remove_view(); }
  ObjectPointer object;
};

py::array_t<double> new_array(const api::Body& body) {
  return py::array_t<double>({py::ssize_t(body.mesh().element_count()), all_columns});
}

py::array checked_out(const py::object& out, std::size_t rows) {
  const bool fits = py::isinstance<py::array_t<double, py::array::c_style>>(out) &&
                    py::cast<py::array>(out).ndim() == 2 && py::cast<py::array>(out).shape(1) == all_columns &&
                    std::size_t(py::cast<py::array>(out).shape(0)) == rows && py::cast<py::array>(out).writeable();
  if (!fits) {
    throw Error("out", "it is not an array that takes the positions",
                "give a writable C-contiguous array of the shape (" + std::to_string(rows) + ", 3) and dtype float64");
  }
  return py::cast<py::array>(out);
}

py::array positions(Object& object, const py::object& out) {
  const UseObject use(object);
  api::Body& body = object.body();
  py::array array = out.is_none() ? py::array(new_array(body)) : checked_out(out, body.mesh().element_count());
  const std::span<double> numbers(static_cast<double*>(array.mutable_data()), std::size_t(array.size()));
  {
    const Unlocked unlocked;
    body.copy_positions(numbers);
  }
  return array;
}

py::array view(const ObjectPointer& object) {
  const UseObject use(*object);
  const api::StoredPositions stored = object->body().stored_positions();
  const bool is_single = stored.precision == api::Precision::single_precision;
  const py::capsule owner(new Lease(object), [](void* lease) { delete static_cast<Lease*>(lease); });
  py::array array(is_single ? py::dtype::of<float>() : py::dtype::of<double>(),
                  {py::ssize_t(object->body().mesh().element_count()), py::ssize_t(stored.columns)},
                  {py::ssize_t(stored.stride), py::ssize_t(is_single ? sizeof(float) : sizeof(double))}, stored.first,
                  owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

void set_positions(Object& object, const py::object& values) {
  const UseObject use(object);
  const std::vector<double> all = positions_on(object.body().mesh(), values);
  const Unlocked unlocked;
  object.body().set_positions(all);
}

}  // namespace

void add_position_view(BodyClass& body) {
  body.def("positions", &positions, py::arg("out") = py::none(),
           "Returns the positions of all elements: shape (element_count, 3), dtype float64 (mesh units). A copy.\n\n"
           "`out` is an array that receives them, if given: writable and C-contiguous, of this shape and dtype. "
           "Nothing\n"
           "is allocated then.")
      .def("view", &view,
           "Returns a read-only view of the positions as they are stored: shape (element_count, space_dimension), "
           "dtype\n"
           "float64 or float32 (mesh units). Its columns are the axes that exist (Mesh.axes).\n\n"
           "Nothing is copied: the array shows every later move, and keeps the body alive. Do not read it while "
           "another\n"
           "thread moves the body. Raises Error if the body does not store positions: with the method `exact`, which\n"
           "stores displacements from rest, in float32 far from the origin, and along turned axes. While a view\n"
           "exists, such a method and other axes are refused.")
      .def("set_positions", &set_positions, py::arg("positions"),
           "Sets the positions of all elements, also of pinned ones: shape (element_count, 3) or, for the axes that\n"
           "exist, (element_count, space_dimension) (mesh units). They are rounded to the precision.\n\n"
           "Raises Error for another shape, a coordinate that is not finite, and one on an axis that does not exist.\n"
           "Nothing has changed then.");
}

}  // namespace chainmail::python
