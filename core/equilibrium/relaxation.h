#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "body/body.h"
#include "equilibrium/link_energy.h"
#include "equilibrium/relaxation_scheme.h"
#include "mesh/fixed_matrix.h"

namespace chainmail {

/// Result of a slice of relaxation: a part of a sweep, or one iteration toward the equilibrium.
struct RelaxationResult {
  std::uint64_t visited = 0;  // number of visited elements
  bool sweep_ended = false;   // true if the slice reached the end of a sweep, or was an iteration
  double largest_step = 0;    // of the sweep so far, Euclidean norm (mesh units)
  /// After an iteration: the estimated distance from the equilibrium, see EquilibriumCertificate.
  std::optional<double> residual = {};
  bool has_prepared = false;  // true if this iteration prepared later ones, which are much faster
  /// After a slice that is fine only where needed: the estimated distance from the equilibrium, root mean square,
  /// relative to the displacements; and the number of unknown positions.
  std::optional<double> estimate = {};
  std::size_t nodes = 0;
};

/// A set of elements, taken in ascending order. Costs nothing outside the range in use.
class ActiveSet {
 public:
  /// Call this before elements are inserted.
  void make_room(std::size_t element_count) { words_.resize((element_count + 63) / 64); }

  void insert(ElementId element) {
    words_[element / 64] |= std::uint64_t{1} << (element % 64);
    first_ = std::min<std::size_t>(first_, element / 64);
    last_ = std::max<std::size_t>(last_, element / 64);
  }

  /// The same in two steps, for many elements: each of them, then bounds of their ids. The words are found once.
  std::uint64_t* words() { return words_.data(); }
  static void insert_in(std::uint64_t* words, ElementId element) {
    words[element / 64] |= std::uint64_t{1} << (element % 64);
  }
  void note_inserted(ElementId least, ElementId most) {
    first_ = std::min<std::size_t>(first_, least / 64);
    last_ = std::max<std::size_t>(last_, most / 64);
  }

  void insert_all(std::size_t element_count) {
    words_.assign((element_count + 63) / 64, ~std::uint64_t{0});
    if (element_count % 64 != 0) {
      words_.back() = (std::uint64_t{1} << (element_count % 64)) - 1;
    }
    first_ = 0;
    last_ = words_.size() - 1;
  }

  /// Removes and returns the smallest element, if any.
  std::optional<ElementId> take() {
    for (; first_ <= last_ && first_ < words_.size(); ++first_) {
      if (std::uint64_t& word = words_[first_]; word != 0) {
        const auto element = static_cast<ElementId>(64 * first_ + std::countr_zero(word));
        word &= word - 1;
        return element;
      }
    }
    first_ = std::numeric_limits<std::size_t>::max();
    last_ = 0;
    return std::nullopt;
  }

  void clear() {
    for (; first_ <= last_ && first_ < words_.size(); ++first_) {
      words_[first_] = 0;
    }
    first_ = std::numeric_limits<std::size_t>::max();
    last_ = 0;
  }

  /// Returns the elements, ascending. They stay in the set.
  std::vector<ElementId> elements() const {
    std::vector<ElementId> result;
    for (std::size_t at = first_; at <= last_ && at < words_.size(); ++at) {
      for (std::uint64_t word = words_[at]; word != 0; word &= word - 1) {
        result.push_back(static_cast<ElementId>(64 * at + std::size_t(std::countr_zero(word))));
      }
    }
    return result;
  }

 private:
  std::vector<std::uint64_t> words_;  // one bit per element
  // All words outside this range are 0.
  std::size_t first_ = std::numeric_limits<std::size_t>::max();
  std::size_t last_ = 0;
};

/// Relaxation of the elastic energy (see equilibrium/link_energy.h), element by element in ascending id. Each element
/// stays inside the intersection of its neighbours' valid regions, axis by axis; on an axis where that is empty it does
/// not move.
///
/// `mean` moves an element toward the position of least energy while all others stay. For isotropic energy that is the
/// mean, over its neighbours, of their position less the rest vector to them. For the other kinds it is the solution of
/// a small linear system; where a region limits the element, it is the position of least energy inside the region. If
/// the system is singular, such as in a straight chain without lateral stiffness, the element stays in the directions
/// that have no energy.
///
/// `link` corrects each link once: each end of the link moves by half the displacement. With the deflection Δ of the
/// link, its direction r̂ and the fraction s = lateral/(axial + lateral) of its weights, the displacement is (1 −
/// s)(r̂·Δ) r̂ + s Δ: along the link all of Δ, across it the fraction b/(1 + b). For isotropic energy s is 1, so the
/// displacement is Δ.
///
/// Sweeps know links only: with the energy of the material, they lower that of corotated links.
///
/// With corotated energy, an element is visited together with its rotation: first its neighbourhood is turned, then it
/// moves, as if the rotations and the directions of links were constant.
///
/// The clamp is this project's: without it, relaxation leaves links outside their regions, and the next pass pulls far
/// elements abruptly (the jumps of thesis 4.4). From a valid state it keeps every link valid, and `mean` with a step in
/// (0, 1] never raises isotropic or axial energy. `link` may, and if links contradict each other it may never end.
///
/// Only active elements are visited: elements that moved, or a neighbour of which moved, since their last visit. Steps
/// below `still` mean rest lengths are not taken and make nothing active, so a scene comes to rest.
///
/// When positions are set from outside, all elements become inactive.
class Relaxation {
 public:
  static constexpr double still = 1e-6;

  void set_scheme(RelaxationScheme scheme) { scheme_ = scheme; }
  /// Makes these elements and their neighbours active from the next sweep on.
  void wake(const Body& body, std::span<const ElementId> elements);
  void wake_all(const Body& body);
  /// Makes all elements inactive.
  void sleep();
  /// The same, and drops the rotations that were found.
  void forget();

  /// Continues the current sweep, or begins one, with a step in (0, 1], until it ends or `budget` elements were
  /// visited. Elements of `held` (ascending) and pinned elements stay. If nothing is active, `visited` is 0 and the
  /// sweep has ended.
  RelaxationResult sweep(Body& body, double step, std::uint64_t budget, std::span<const ElementId> held);

  /// The elements that the last slice moved, once per move.
  std::span<const ElementId> moved() const { return moved_; }

 private:
  template <class View>
  class Slice;

  void follow(const Body& body);
  void follow_energy(const Body& body);
  void end_sweep();

  RelaxationScheme scheme_ = RelaxationScheme::mean;
  std::vector<LinkWeights> weights_;  // of each link, except for isotropic energy
  std::uint64_t energy_ = 0;          // revision of the energy that the weights belong to
  /// For corotated energy, of each element: the rotation of its neighbourhood, and when it was found. Passes move
  /// elements, so rotations of before the last call of wake count no more.
  std::vector<FixedMatrix<double, 3, 3>> rotations_;
  std::vector<std::uint32_t> turned_;
  std::uint32_t wakes_ = 1;
  ActiveSet current_;  // to be visited in this sweep
  ActiveSet next_;     // to be visited in the next sweep
  std::vector<ElementId> moved_;
  bool in_sweep_ = false;
  double largest_step_ = 0;      // of this sweep (mesh units)
  std::uint64_t positions_ = 0;  // revision of the positions that the active elements belong to
};

}  // namespace chainmail
