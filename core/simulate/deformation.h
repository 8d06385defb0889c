#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "body/method.h"
#include "measure/shape_measures.h"
#include "simulate/simulation.h"

namespace chainmail {

/// The passes of a deformation, and the state of the object after them.
struct DeformSummary {
  struct Pass {
    std::vector<ElementId> handle;  // ascending
    Point target = Point::Zero();   // of its pivot (mesh units)
    Rotation rotation = {};         // since it was grabbed
    std::uint64_t checked = 0;
    std::uint64_t moved = 0;
    double milliseconds = 0;
    std::optional<Point> stopped_at = {};  // where the pivot is, if the handle stopped before its target (mesh units)
    std::string remark = {};               // reason why it did not end as requested; usually empty
    double relaxation_ms = 0;              // of the relaxation after it
  };
  /// Of relaxation that is fine only where needed, after the last pass.
  struct Local {
    double estimate = 0;  // see RelaxationResult
    std::size_t nodes = 0;
  };

  Algorithm algorithm = Algorithm::natural_queue;
  std::uint64_t elements = 0;
  std::uint64_t links = 0;
  std::vector<Pass> passes;
  Violation violation;
  double energy = 0;
  Displacement displacement;
  // Figures about the shape; none where they are not defined.
  std::optional<double> volume_change = {};                // relative
  std::optional<std::uint64_t> inverted_cells = {};        // number of them
  std::optional<double> largest_stretch = {};              // principal stretch
  std::optional<EquilibriumCertificate> equilibrium = {};  // if it was relaxed to the equilibrium
  std::optional<CellFigures> cells = {};                   // of an object with cells
  std::optional<Local> local = {};
};

/// A simulation that notes what each of its passes did.
class Deformation {
 public:
  /// What each pass does.
  struct EachPass {
    int relax = 0;           // sweeps of relaxation, or most iterations, with the scheme last set
    double relax_until = 0;  // residual that ends the iterations
    bool traced = false;     // notes every candidate
    std::function<void()> on_end = [] {};
  };
  Deformation(MeshPointer mesh, Algorithm algorithm, Precision precision, EachPass each);

  /// Carries out a command. A drag is a pass.
  void apply(const Command& command);
  /// Grabs an element, drags it to a position (mesh units) in equal steps of one pass each, and releases it.
  void move(ElementId element, const Point& target, std::uint32_t steps);
  /// Moves what is grabbed, from where it is, by a displacement and a rotation, in equal steps of one pass each.
  void move_handle(const Point& by, const Rotation& rotation, std::uint32_t steps);

  const Simulation& simulation() const { return simulation_; }
  /// Returns what each pass did, and measures the object.
  DeformSummary summary();
  /// The candidates of each traced pass.
  const std::vector<Trace>& traces() const { return traces_; }

 private:
  void pass(const commands::Drag& drag);

  Simulation simulation_;
  EachPass each_;
  commands::Drag handle_ = {};  // where the handle is, since it was grabbed
  std::vector<DeformSummary::Pass> passes_;
  std::vector<Trace> traces_;
  std::uint64_t traced_ = 0;  // rows of all traces
};

}  // namespace chainmail
