#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "body/body.h"
#include "equilibrium/local_minimum.h"

namespace chainmail {

/// Relaxation of the material, fine only where needed: the minimum of the same energy over fewer unknowns. These are
/// the elements near the rim of the handle and near cuts, and the corners of cubes elsewhere, which are the wider the
/// farther they are and the less the strain changes (see local_minimum.h). What is hidden inside the object is written
/// only by finish().
///
/// For objects with cells in space, with the neo-Hookean law and open valid regions, which do not count here.
class LocalRelaxation {
 public:
  struct Options {
    double theta = 0.5;
    double widest = 1.0 / 12;  // of the longest side of the object
    double tolerance = 0.01;
    int max_iterations = 5;
    bool has_twin = false;  // also at half the resolution, for an estimate of the error
  };
  struct Result {
    std::size_t nodes = 0, tetrahedra = 0;
    int iterations = 0;
    double distance = 0;             // from the minimum over the unknowns, as √(energy of it / energy)
    std::optional<double> estimate;  // of the error: root mean square, relative to the displacements
    double least_ratio = 1;          // of volumes; below 0 if a tetrahedron is inverted
  };

  /// Returns true if a body's object and energy are of the kind that this is for, and large enough to be worth it.
  static bool is_for(const Body& body);
  /// Returns true if this was built for a body's object.
  bool is_of(const Body& body) const { return mesh_ == body.stored_mesh(); }
  /// Returns true if this is what would be built for a body now, or if the handle moves, and was so when it began.
  bool fits(const Body& body) const;

  /// Builds the cubes, which know the cuts if they are many: takes about as long as ten iterations to the equilibrium.
  /// Throws Cancelled.
  LocalRelaxation(const Body& body, const Options& options, const Progress& progress = {});

  /// Follows the handle, which is where the body has it, and writes the elements that are fine or on the surface.
  Result update(Body& body, std::span<const ElementId> held);
  /// Writes all elements.
  void finish(Body& body) { write_to(body, true); }
  /// Call this when no handle moves any more: the next one starts from the positions of the body.
  void release() { starts_anew_ = true; }
  /// The elements that the last call wrote, each once.
  std::span<const ElementId> moved() const { return moved_; }

 private:
  void follow(const Body& body, std::span<const ElementId> held);
  std::vector<ElementId> follow_cuts(const Body& body);
  void write_to(Body& body, bool everything);
  template <class View>
  void write(const View& view, bool everything);
  template <class View>
  void write_leaf(const View& view, int l, std::uint32_t cube, bool everything);
  void read(const PositionView& positions, ElementId element, Doubles4& displacement) const;
  void read_fixed(const Body& body, std::span<const ElementId> elements);
  template <class View>
  void write_element(const View& view, ElementId element, const double* rest, const Doubles4& displacement);
  double difference() const;

  Options options_;
  MeshPointer mesh_;
  CubeSpace space_;
  FixedElements fixed_;
  LocalMinimum minimum_;
  std::optional<LocalMinimum> twin_;
  Revisions seen_;
  std::vector<LinkId> known_cuts_;  // by the cubes, ascending
  std::vector<LinkId> cut_links_;
  std::vector<std::uint8_t> is_gone_;  // of each tetrahedron
  std::vector<LocalMinimum::Box> boxes_;
  bool has_begun_ = false, starts_anew_ = false;
  double size_ = 0;  // of the motion of the handle (units)
  std::vector<ElementId> moved_;
};

}  // namespace chainmail
