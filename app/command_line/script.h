#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "body/blade.h"
#include "mesh/mesh.h"
#include "simulate/deformation.h"

namespace chainmail::command_line {

/// An action of the command line. Actions run in the given order.
struct Action {
  enum class Kind { move, by, cut, pin, grab, rotate, blade, along };

  Kind kind = Kind::move;
  std::string where;  // the option and its value, for error messages
  ElementId element = 0;
  ElementId other = 0;                                       // cut: the other end of the link
  std::vector<double> coordinates = {};                      // move, by: the given ones of x, y and z
  std::string layer = {};                                    // pin, grab: the name of a layer; empty for elements
  std::vector<std::pair<ElementId, ElementId>> ranges = {};  // pin, grab: the first and the last element of each range
  Rotation rotation = {};                                    // rotate
  Blade blade = {};                                          // blade: what splits the object; along: its direction
  bool of_handle = false;                                    // by, rotate: moves what the last --grab has grabbed
};

/// Reads `ID:X[,Y[,Z]]` for a move, the same or `X[,Y[,Z]]` for a move of what is grabbed, `A-B` for a cut, `ID` or the
/// name of a layer for a pin, `ID,A-B,…` or the name of a layer for a grab, `AXIS:DEGREES` for a rotation,
/// `X,Y,Z;X,Y,Z;…` for the line of a blade, and `DX,DY,DZ` for its direction. Throws Error naming the option.
Action parse_action(Action::Kind kind, const std::string& option, const std::string& text);
/// Adds an action. The direction of a blade becomes part of the blade directly before it; throws Error if there is
/// none.
void add_action(std::vector<Action>& actions, Action action);

/// Throws Error if an action does not fit the mesh or the actions before it: if the element, link or axis does not
/// exist, or if a moved element is already pinned, if an element is grabbed twice, or if nothing is grabbed. Also if
/// moves of this number of passes have too many in all: the results have a row for each. Actions behind a split are
/// checked when they run, because it adds elements.
void check_actions(const std::vector<Action>& actions, const Mesh& mesh, std::uint32_t steps);

/// Returns the number of passes that carry_out() makes.
std::uint64_t passes_of(const std::vector<chainmail::Command>& recorded, const std::vector<Action>& actions,
                        std::uint32_t steps);
/// Runs the recorded moves, then the actions, with this number of passes per move.
void carry_out(Deformation& deformation, const std::vector<chainmail::Command>& recorded,
               const std::vector<Action>& actions, std::uint32_t steps);

}  // namespace chainmail::command_line
