#pragma once

#include <pybind11/pybind11.h>

#include <string_view>
#include <type_traits>
#include <vector>

#include "body/softness.h"
#include "python/arrays.h"
#include "python/object.h"

namespace chainmail::python {

// Types of arguments of the functions that Python calls.

enum class IdKind { element, link };
constexpr const char* word_for(IdKind kind) { return kind == IdKind::element ? "element" : "link"; }

/// An id, which may exist in no mesh.
template <IdKind Kind>
struct Id {
  std::uint32_t number = 0;

  /// Returns the number. Throws Error if the mesh has no such element or link.
  std::uint32_t in(const Mesh& mesh) const {
    if constexpr (Kind == IdKind::element) {
      check_element(mesh, number);
    } else {
      check_links(mesh, std::span(&number, 1));
    }
    return number;
  }
};
using Element = Id<IdKind::element>;
using Link = Id<IdKind::link>;

/// Ids from a sequence, from an array, or a single one. They may exist in no mesh.
template <IdKind Kind>
struct Ids : std::vector<std::uint32_t> {};
using Elements = Ids<IdKind::element>;
using Links = Ids<IdKind::link>;

/// An enumeration is a word in Python.
struct Words {
  const char* name;                   // in errors
  std::vector<std::string_view> all;  // in the order of the constants
};
template <class Kind>
const Words& words();
template <>
const Words& words<Precision>();
template <>
const Words& words<RelaxationScheme>();
template <>
const Words& words<EnergyKind>();
/// Returns the index of a word. Throws Error, with all words, if it is not in the list.
std::size_t index_of(const Words& words, std::string_view word);

template <class Kind>
Kind constant_for(std::string_view word) {
  return Kind(index_of(words<Kind>(), word));
}
template <>
inline Algorithm constant_for<Algorithm>(std::string_view word) {
  return algorithm_of(word);
}
template <class Kind>
std::string_view word_for(Kind kind) {
  return words<Kind>().all[std::size_t(kind)];
}
inline std::string_view word_for(Algorithm method) { return info(method).offered_name(); }

}  // namespace chainmail::python

namespace pybind11::detail {

template <chainmail::python::IdKind Kind>
struct type_caster<chainmail::python::Id<Kind>> {
  PYBIND11_TYPE_CASTER(chainmail::python::Id<Kind>, const_name("object"));
  bool load(handle source, bool /*convert*/) {
    value.number = chainmail::python::id_of(source, word_for(Kind));
    return true;
  }
};

template <chainmail::python::IdKind Kind>
struct type_caster<chainmail::python::Ids<Kind>> {
  PYBIND11_TYPE_CASTER(chainmail::python::Ids<Kind>, const_name("object"));
  bool load(handle source, bool /*convert*/) {
    value = {chainmail::python::ids_of(source, word_for(Kind))};
    return true;
  }
};

template <class Kind>
requires std::is_enum_v<Kind>
struct type_caster<Kind> {
  PYBIND11_TYPE_CASTER(Kind, const_name("str"));
  bool load(handle source, bool convert) {
    make_caster<std::string> word;
    if (!word.load(source, convert)) {
      return false;
    }
    value = chainmail::python::constant_for<Kind>(cast_op<std::string&>(word));
    return true;
  }
  static handle cast(Kind kind, return_value_policy /*policy*/, handle /*parent*/) {
    return pybind11::cast(chainmail::python::word_for(kind)).release();
  }
};

/// The argument is marked when the call begins.
template <class Owner>
struct type_caster<chainmail::python::Used<Owner>> : make_caster<Owner> {
  using Used = chainmail::python::Used<Owner>;
  template <class>
  using cast_op_type = Used;
  operator Used() { return Used(make_caster<Owner>::operator Owner&()); }
};

}  // namespace pybind11::detail
