#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "body/snapshot.h"
#include "body/softness.h"
#include "equilibrium/relaxation_scheme.h"
#include "mesh/cuts.h"
#include "mesh/described.h"
#include "mesh/mesh.h"
#include "mesh/split.h"
#include "solver/deformer.h"

namespace chainmail {

/// Commands: every change of a simulation is one. Commands are values: they can be recorded, sent to several
/// simulations and replayed. Those with a name, and help for schemas, can be in files: see files/session/moves.h.
namespace commands {

/// Grabs an element, or many that move as one rigid body; nothing moves yet.
struct Grab {
  static constexpr std::string_view name = "grab", help = "grabs one element, or several as a rigid body";
  Grab(ElementId element = 0) : elements{element} {}
  explicit Grab(std::vector<ElementId> grabbed) : elements(std::move(grabbed)) {}

  std::vector<ElementId> elements;
};
/// Moves the handle: one pass.
struct Drag {
  static constexpr std::string_view name = "drag", help = "moves the handle in one pass";
  /// Of its pivot, which is the mean of the grabbed positions (mesh units): a position, or, if `relative`, a
  /// displacement from where it was grabbed.
  Point target = Point::Zero();
  Rotation rotation = {};  // about the pivot, since it was grabbed
  bool relative = false;
};
/// Releases the handle.
struct Release {
  static constexpr std::string_view name = "release", help = "releases the handle";
};
/// Sets the softness. It is shared, so that the command does not copy the softness of single links.
struct SetSoftness {
  static constexpr std::string_view name = "softness", help = "replaces the softness of all links";
  SetSoftness(std::shared_ptr<const Softness> set = std::make_shared<const Softness>()) : softness(std::move(set)) {}
  explicit SetSoftness(Softness set) : SetSoftness(std::make_shared<const Softness>(std::move(set))) {}

  std::shared_ptr<const Softness> softness;
};
/// Turns relaxation in idle time on or off, with a step: see parameters::relax_step. The scheme `equilibrium` ignores
/// it.
struct SetRelaxation {
  bool on = false;
  double step = parameters::relax_step.default_value;
  RelaxationScheme scheme = RelaxationScheme::mean;
  bool anew = false;   // all elements begin again, even if it was on
  bool local = false;  // with the scheme `equilibrium`: fine only where needed, see Deformer::set_relaxation

  bool operator==(const SetRelaxation&) const = default;
};
/// Runs up to this many sweeps of relaxation at once, even if relaxation is off. The scheme `equilibrium` runs
/// iterations, and ends earlier if it reaches a residual.
struct Relax {
  static constexpr std::string_view name = "relax", help = "relaxes the object";
  std::uint32_t sweeps = 1;
  double step = parameters::relax_step.default_value;
  RelaxationScheme scheme = RelaxationScheme::mean;
  double until = 0;    // residual to reach: see parameters::relax_until. 0: none
  bool local = false;  // fine only where needed, as in SetRelaxation
};
/// Number of slices of relaxation in each panel. A solver notes it when it reaches the command that follows them.
class SliceCounts {
 public:
  explicit SliceCounts(std::size_t panels) : panels_(panels) {}

  std::size_t size() const { return panels_.size(); }
  void note(std::size_t panel, Algorithm algorithm, std::uint32_t slices);
  /// Return what a panel did. They wait until it is noted.
  std::uint32_t slices(std::size_t panel) const;
  Algorithm algorithm(std::size_t panel) const;
  /// Returns the number of slices for a simulation that runs `algorithm` in place of this panel: that of a panel with
  /// the same algorithm, if there is one.
  std::uint32_t slices_for(std::size_t panel, Algorithm algorithm) const;

 private:
  static constexpr std::uint32_t unknown = ~std::uint32_t{0};
  struct Panel {
    Algorithm algorithm = Algorithm::natural_queue;
    std::atomic<std::uint32_t> slices = unknown;
  };
  std::vector<Panel> panels_;
};
/// What relaxation did in idle time since the command before. It is recorded, and repeats that when it is carried out:
/// to the bit, if everything before it is repeated, too.
struct Relaxed {
  static constexpr std::string_view name = "relaxed", help = "what relaxation did in idle time";
  enum class Start { goes_on, awake, asleep };
  static constexpr std::array<std::string_view, 3> starts{"goes on", "awake", "asleep"};

  RelaxationScheme scheme = RelaxationScheme::mean;
  double step = parameters::relax_step.default_value;
  /// What happened before: nothing, all elements woke, or none was awake any more, after undo.
  Start start = Start::goes_on;
  std::shared_ptr<const SliceCounts> counts;
  std::size_t panel = 0;  // of the simulation that carries it out
  bool local = false;     // as in SetRelaxation
};
/// Sets the options of methods of elasticity and free-form deformation.
struct SetElastic {
  ElasticOptions options;
};
struct SetAlgorithm {
  Algorithm algorithm = Algorithm::natural_queue;
};
struct Cut {
  static constexpr std::string_view name = "cut", help = "cuts links";
  std::vector<LinkId> links;
};
struct Uncut {
  static constexpr std::string_view name = "uncut", help = "joins cut links again";
  std::vector<LinkId> links;
};
/// Pins elements at their current positions. Grabbed elements cannot be pinned.
struct Pin {
  static constexpr std::string_view name = "pin", help = "pins elements";
  std::vector<ElementId> elements;
};
struct Unpin {
  static constexpr std::string_view name = "unpin", help = "unpins elements";
  std::vector<ElementId> elements;
};
/// Moves all elements to rest. Cuts, pins and softness stay.
struct Reset {
  static constexpr std::string_view name = "reset", help = "returns to rest";
};
/// Replaces the object by another one at rest, without cuts and pins. If the algorithm does not support the new mesh,
/// Natural Queue replaces it. The softness of single links is dropped; the global softness stays.
struct ReplaceMesh {
  MeshPointer mesh;
};
/// Splits cells or faces of the object along a stroke. Its positions, cuts, pins and softness go over to the new
/// elements and links. The object must have the mesh before the split.
struct Split {
  static constexpr std::string_view name = "split", help = "divides cells or faces, and appends elements";
  SplitPointer split;
};

/// Restores positions. The snapshot must be of this mesh.
struct SetPositions {
  std::shared_ptr<const Snapshot> snapshot;
};

/// Id of a state that a simulation saves for undo.
using StateId = std::uint64_t;
/// Saves the current object (mesh, cuts, pins, softness, positions) under an id.
struct KeepState {
  StateId state = 0;
};
/// Restores the object from a saved state. The state stays saved.
struct RestoreState {
  StateId state = 0;
};
/// Drops a saved state.
struct DropState {
  StateId state = 0;
};

}  // namespace commands

template <>
inline constexpr std::array members_of<commands::SetRelaxation>{
    yes_or_no<&commands::SetRelaxation::on>("on", "true while the object relaxes in idle time"),
    choice<&commands::SetRelaxation::scheme>("scheme", relaxation_scheme_names, "what relaxation does"),
    number<&commands::SetRelaxation::step>("step", parameters::relax_step),
    left_out_by_default(yes_or_no<&commands::SetRelaxation::local>("local", parameters::fine_where_needed))};
template <>
inline constexpr std::array members_of<commands::Relax>{
    number<&commands::Relax::sweeps>("sweeps", parameters::relax_sweeps),
    may_be_absent(number<&commands::Relax::step>("step", parameters::relax_step)),
    may_be_absent(choice<&commands::Relax::scheme>("scheme", relaxation_scheme_names, "what relaxation does")),
    left_out_by_default(number<&commands::Relax::until>("until", parameters::relax_until)),
    left_out_by_default(yes_or_no<&commands::Relax::local>("local", parameters::fine_where_needed))};
template <>
inline constexpr std::array members_of<commands::Relaxed>{
    choice<&commands::Relaxed::scheme>("scheme", relaxation_scheme_names, "what relaxation did"),
    number<&commands::Relaxed::step>("step", parameters::relax_step),
    choice<&commands::Relaxed::start>("start", commands::Relaxed::starts, "what happened before"),
    left_out_by_default(yes_or_no<&commands::Relaxed::local>("local", parameters::fine_where_needed))};

using Command = std::variant<commands::Grab, commands::Drag, commands::Release, commands::SetSoftness,
                             commands::SetRelaxation, commands::Relax, commands::Relaxed, commands::SetAlgorithm,
                             commands::Cut, commands::Uncut, commands::Pin, commands::Unpin, commands::Reset,
                             commands::ReplaceMesh, commands::SetPositions, commands::KeepState, commands::RestoreState,
                             commands::DropState, commands::SetElastic, commands::Split>;

/// Returns true if a command is of one of these kinds.
template <class... Kinds>
bool is_one_of(const Command& command) {
  return (std::holds_alternative<Kinds>(command) || ...);
}

}  // namespace chainmail
