#pragma once

#include <optional>
#include <string>

#include "measure/converging_reference.h"
#include "report/run/cases.h"

namespace chainmail::report {

/// Throws Error, with the reason, if physics has no solution for an object of this kind, without pins or with cuts.
/// Cheap: cells and parts are not checked.
void check_reference(const std::string& name, const Mesh& mesh, bool has_pins, bool has_cuts);

/// What the answers at the end of a drag are compared with.
struct DragReference {
  ReferenceSolution solution;
  std::optional<ConvergedReference> refined = {};  // its levels, if it was computed on refined cells
  bool is_closed_form = false;

  /// By how much the last refinement changed it, as a share of its RMS displacement; none without refinement.
  std::optional<double> change() const {
    return refined && !refined->levels.empty() ? refined->levels.back().change : std::nullopt;
  }
};

/// The references of the drags of one object.
class DragReferences {
 public:
  /// Handles of many elements have references on refined cells, if `refine` is given. The object must outlive this.
  /// Throws Error, with the name of the object, if physics has no solution for it.
  DragReferences(const Case& object, const std::optional<ConvergingOptions>& refine);

  /// Returns the closed form of the drag, if it has one, else a solution by finite elements. Throws Error if there is
  /// none.
  DragReference at_end(const RecordedMoves& moves);

 private:
  const Case& object_;
  std::optional<ConvergingOptions> refine_;
  std::optional<ReferenceSolver> solver_;       // without a cut; later, where every refined level is asked for
  std::optional<ConvergingReference> refined_;  // without a cut; made when it is first needed
};

/// Returns the motion of the handle from rest to the end of a drag, about the mean of its rest positions.
RigidMotion motion_at_end(const Mesh& mesh, const RecordedMoves& moves);

}  // namespace chainmail::report
