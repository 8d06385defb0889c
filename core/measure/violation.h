#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

#include "body/softness.h"
#include "elastic/material.h"
#include "mesh/cuts.h"
#include "mesh/element_blocks.h"
#include "mesh/mesh.h"
#include "solver/deformer.h"

namespace chainmail {

/// Smallest violation that counts, in rest lengths of the link. Smaller ones are rounding errors.
inline constexpr double counts_as_violated = 1e-4;

/// Distance of links from their valid regions, in rest lengths of the link (for a link of zero length: in the mesh's
/// mean rest length). Cut links do not count.
struct Violation {
  double max = 0;
  double rms = 0;
  double fraction = 0;      // share of the measured links that count as violated
  std::uint64_t links = 0;  // number of measured links

  bool operator==(const Violation&) const = default;
};

/// Returns the violation of one link: the Euclidean norm of the excess per axis. Computed in double.
double link_violation(const Mesh& mesh, const Softness& softness, const PositionView& position, LinkId link);
/// The same of a link of an object. Throws Error if there is no such link.
double link_violation(const Body& body, LinkId link);

/// Returns the violation of the whole mesh.
Violation measure_violation(const Mesh& mesh, const Softness& softness, const Cuts& cuts, const PositionView& position);
Violation measure_violation(const Body& body);

/// Collects the violations of links.
class ViolationSum {
 public:
  void add(double violation);
  void add(const ViolationSum& other);
  Violation result() const;

 private:
  double max_ = 0;
  double squares_ = 0;
  std::uint64_t violated_ = 0;
  std::uint64_t links_ = 0;
};

/// The violation of an object, from one measurement. Everything that shows it reads the same one.
struct MeasuredViolation : Violation {
  bool is_whole = false;                       // false: some links that changed are not measured yet and do not count
  std::chrono::steady_clock::time_point at{};  // when it was measured
};

/// Measures the violation of all links of an object again after each change. It keeps the sums of blocks of links, so
/// the cost depends on what changed.
class ViolationMeter {
 public:
  ViolationMeter() = default;

  /// The elements of these blocks may have moved.
  void forget(const Mesh& mesh, const ElementBlocks& moved);
  /// These links were cut or restored.
  void forget(std::span<const LinkId> links);
  /// The softness has changed.
  void forget_all() { stale_.insert_all(); }
  /// True if no link has to be measured again.
  bool is_complete() const { return stale_.empty(); }
  /// Measures links that changed, about `most` of them at once, here and there in the object. Allocates memory only for
  /// the first measurement.
  MeasuredViolation measure(const Mesh& mesh, const Softness& softness, const Cuts& cuts, const PositionView& position,
                            LinkId most);

 private:
  static constexpr LinkId block_links = ElementBlocks::block_elements;

  explicit ViolationMeter(LinkId links);
  template <class Visit>
  void for_each_measured(std::size_t most, Visit visit);
  Violation total();

  ElementBlocks stale_;            // blocks of links to measure
  ElementBlocks left_, measured_;  // while only some of them are measured
  ElementBlocks groups_;           // groups of 64 blocks whose sums are out of date
  std::vector<ViolationSum> sums_, sums_of_groups_;
  std::size_t next_ = 0, stride_ = 1;  // the next block, if only some are measured, and the way to the one after it
};

/// Returns the elastic energy of an object: see equilibrium/link_energy.h.
double elastic_energy(const Body& body);

/// Returns the displacement of the elements from rest (mesh units), in double.
struct Displacement {
  double max = 0;
  double rms = 0;
};
Displacement measure_displacement(const Mesh& mesh, const PositionView& position);

}  // namespace chainmail
