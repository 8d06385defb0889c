#pragma once

#include <string>

#include "core/families.h"
#include "mesh/error.h"

namespace chainmail::test {

/// A chain of twelve elements with Exact ChainMail, links between 0.75 and 1.25 long, and some elements pinned.
inline std::unique_ptr<Deformer> pinned_chain(Precision precision, const std::vector<ElementId>& pins) {
  auto solver = std::make_unique<Deformer>(make_mesh(MeshKind::line, {12, 1, 1}), Algorithm::exact, precision);
  solver->body().set_softness({{0.75, 1.25, 0}, {}});
  solver->body().pin(pins);
  return solver;
}

/// Returns the message of the Error that `act` throws, or an empty text.
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
