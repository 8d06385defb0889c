#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/families.h"
#include "core/simulations.h"
#include "measure/violation.h"
#include "simulate/simulation.h"

namespace chainmail::hard {

/// What was true at the end of a hard case.
struct Outcome {
  bool finite = true;           // every position is a number
  bool anchors = true;          // pins are unmoved, and the handle is at its target (Exact: or stopped by pins)
  bool stopped = false;         // pins stopped the handle
  Violation violation;          // of the whole mesh, in rest lengths
  double rounding = 0;          // the violation that rounding alone explains, in rest lengths
  std::optional<double> drift;  // defined by the case, in mean rest lengths
};

/// An algorithm, perhaps with relaxation to the equilibrium at the end of the case.
struct Contender {
  Algorithm algorithm;
  bool equilibrium = false;
  EnergyKind energy = link_energy;
};
std::string label(const Contender& contender);

/// A simulation that records what must be true at the end.
class Scene {
 public:
  Scene(MeshPointer mesh, const Contender& contender, Precision precision, const Softness& softness);

  void apply(const Command& command) { simulation_.apply(command); }
  /// Grabs an element and drags it to a target, in equal steps from its position.
  void drag(ElementId element, const Point& target, int steps = 1);
  void drag_by(ElementId element, const Point& by, int steps = 1);
  void pin(const std::vector<ElementId>& elements);
  void set_softness(Softness softness);

  std::vector<double> positions() const { return test::positions_of(simulation_); }
  /// Goes to the equilibrium, if the contender does, and returns what is true there.
  Outcome outcome();

 private:
  bool is_at(ElementId element, const Point& position, double ulps) const;
  double shortest_link() const;

  void relax();

  Simulation simulation_;
  Contender contender_;
  Precision precision_;
  std::optional<ElementId> handle_;
  Point target_ = Point::Zero();
  bool stopped_ = false;
  std::vector<std::pair<ElementId, Point>> pins_;
  double largest_ = 0;  // displacement or move so far (mesh units)
};

/// Largest distance between two states, in mean rest lengths.
double distance_between(const Mesh& mesh, const std::vector<double>& one, const std::vector<double>& other);

struct Case {
  std::string name;
  MeshPointer mesh;
  std::function<Outcome(const Contender&, Precision)> run;
};

/// Returns all hard cases. Those with a million moves or elements are included only if `large` is true.
std::vector<Case> cases(bool large);

}  // namespace chainmail::hard
