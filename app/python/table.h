#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

namespace chainmail::python {

/// A table as a dictionary of columns: a list for each name, all of one length. pandas.DataFrame takes it as it is.
class Table {
 public:
  template <class Value>
  void put(const char* column, const Value& value) {
    if (!columns_.contains(column)) {
      columns_[column] = pybind11::list();
    }
    columns_[column].cast<pybind11::list>().append(pybind11::cast(value));
  }
  const pybind11::dict& columns() const { return columns_; }

 private:
  pybind11::dict columns_;
};

}  // namespace chainmail::python
