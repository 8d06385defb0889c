#pragma once

#include <string>

#include "core/families.h"
#include "mesh/error.h"

namespace chainmail::test {

/// A chain of twelve by Exact ChainMail, of links between 0.75 and 1.25, with some elements pinned.
inline std::unique_ptr<Solver> pinned_chain(Precision precision, const std::vector<ElementId>& pins) {
  auto solver = make_solver(make_mesh(MeshKind::line, {12, 1, 1}), Algorithm::exact, precision);
  solver->set_softness({{0.75, 1.25, 0}, {}});
  solver->pin(pins);
  return solver;
}

/// A sentence that an Error says, or nothing.
template <class Act>
std::string refusal(Act act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace chainmail::test
