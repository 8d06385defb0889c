#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "files/results/summary.h"
#include "simulate/simulation.h"

namespace chainmail::command_line {

/// An action of the command line. Actions run in the given order.
struct Act {
  enum class Kind { move, by, cut, pin };

  Kind kind = Kind::move;
  std::string where;  // the option and its value, for error messages
  ElementId element = 0;
  ElementId other = 0;              // cut: the other end of the link
  std::vector<double> coordinates;  // move, by: the given ones of x, y and z
  std::string layer;                // pin: the name of a layer; empty for one element
};

/// Reads `ID:X[,Y[,Z]]` for a move, `A-B` for a cut, `ID` or the name of a layer for a pin. Throws Error naming the
/// option.
Act parse_act(Act::Kind kind, const std::string& option, const std::string& text);

/// Throws Error if an act does not fit the mesh or the acts before it: if the element, link or axis does not exist, or
/// if a moved element is already pinned.
void check_acts(const std::vector<Act>& acts, const Mesh& mesh);

/// Settings that apply to each move.
struct Schedule {
  std::uint32_t steps = 1;  // passes per move
  std::uint32_t relax = 0;  // sweeps after each pass
  double relax_step = 1;
  bool trace = false;
};

struct Run {
  std::vector<DeformSummary::Pass> passes;
  std::vector<Trace> traces;
};

/// Runs the recorded moves, then the acts. Shows progress on a terminal.
Run carry_out(Simulation& simulation, const std::vector<chainmail::Command>& moves, const std::vector<Act>& acts,
              const Schedule& schedule);

}  // namespace chainmail::command_line
