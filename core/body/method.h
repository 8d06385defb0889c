#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "body/handle.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// Names an algorithm in code. Each one has exactly one entry in the table of solver/algorithms.cpp.
enum class Algorithm {
  generalized,
  spiral,
  natural_queue,
  enhanced,
  chainmail_3d,
  exact,
  linear_fem,
  neo_hookean,
  boundary_elements,
  free_form,
  corotational,
  arap,
  xpbd,
  projective,
  quasi_newton,
  neo_hookean_xpbd
};

/// One processed candidate of a pass.
struct TraceRow {
  ElementId element;
  ElementId sponsor;  // no_element for a candidate without one
  bool moved;
};
using Trace = std::vector<TraceRow>;

/// Numbers of a pass: candidates processed, and elements moved, without the handle.
struct PassCount {
  std::uint64_t checked = 0;
  std::uint64_t moved = 0;
  /// Exact ChainMail: pins, or in a rotation links outside the handle, stopped it before its target.
  bool stopped = false;
  std::uint64_t visits = 0;  // Exact ChainMail: visits of elements, including those before pins stopped the handle
};

/// What a pass reports besides its numbers.
struct PassOutput {
  /// The elements that the pass moved, in order of update if it has one, without the handle. Between passes, nothing
  /// but the method changes it.
  std::vector<ElementId>& moved;
  Trace* trace = nullptr;  // if given, receives every processed candidate
  int threads = 1;         // that the pass may use; their number changes no position
  Progress progress = {};  // of long preparations and solutions. When it throws Cancelled, nothing has moved
};

/// What answers a move of the handle on a body: one algorithm. It belongs to one body, and may keep what it can use
/// again in the next move, with the revisions of the body that it was made for.
class Method {
 public:
  virtual ~Method() = default;

  /// Moves the handle to its target and answers: one pass. No element of the handle is pinned. Throws Error if a target
  /// is not a finite number of the body's precision, and if there is no answer; nothing has moved then.
  virtual PassCount move(Body& body, HandleMove& move, PassOutput output) = 0;

  /// Prepares the first move of an element, in idle time, as if it moved the whole object: that move may then be as
  /// fast as a later one. No position may depend on it. Throws Cancelled.
  virtual void prepare(Body& /*body*/, ElementId /*element*/, int /*threads*/, const Progress& /*progress*/) {}

  /// Reason why the last pass did not reach its target or did not converge. Usually empty.
  virtual std::string remark() const { return {}; }
};

/// Makes a method for bodies of a precision and a space dimension. A method that is added by a program outside may
/// carry data of its own.
using MakeMethod = std::function<std::unique_ptr<Method>(Precision precision, int dimension)>;

/// Makes a method that is a template of the scalar and the space dimension.
template <template <class Scalar, int Dimension> class Typed>
std::unique_ptr<Method> make_method(Precision precision, int dimension) {
  const auto make = [dimension]<class Scalar>(Scalar) {
    switch (dimension) {
      case 1:
        return std::unique_ptr<Method>(new Typed<Scalar, 1>);
      case 2:
        return std::unique_ptr<Method>(new Typed<Scalar, 2>);
      default:
        return std::unique_ptr<Method>(new Typed<Scalar, 3>);
    }
  };
  return precision == Precision::single_precision ? make(float{}) : make(double{});
}

}  // namespace chainmail
