#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/simulations.h"
#include "mesh/error.h"
#include "mesh/parts.h"

/// What an object must look like, computed here from the numbers of its mesh and of its commands. Nothing below asks
/// the program's own functions about poses, parts or regions, which may be wrong in the same way everywhere.
namespace chainmail::test {

/// The two elements of a link, the lower id first. Unlike the ids of links, they outlive a split.
using Ends = std::array<ElementId, 2>;

/// The parts that links still join: a union-find over those that are left.
class LinkedParts {
 public:
  LinkedParts(const Mesh& mesh, const std::set<Ends>& cuts) : above_(mesh.element_count()) {
    std::iota(above_.begin(), above_.end(), 0);
    for (const Ends& ends : mesh.links) {
      if (!cuts.contains(ends)) {
        above_[of(ends[0])] = of(ends[1]);
      }
    }
  }
  ElementId of(ElementId element) const {
    while (above_[element] != element) {
      element = above_[element];
    }
    return element;
  }
  std::uint32_t count() const {
    std::uint32_t roots = 0;
    for (ElementId e = 0; e < above_.size(); ++e) {
      roots += above_[e] == e ? 1 : 0;
    }
    return roots;
  }

 private:
  std::vector<ElementId> above_;
};

/// Turns a vector about z, counterclockwise as seen from the tip of z.
inline Point turned_about_z(const Point& v, double degrees) {
  const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y(), v.z()};
}

/// Returns how far a link lies outside its valid region, along the axis on which this is most (mesh units). The axes of
/// regions are those of the world, turned about z by some degrees.
inline double link_excess(const Point& rest, const Point& now, const LinkSoftness& softness, double degrees) {
  const Point r = turned_about_z(rest, -degrees), x = turned_about_z(now, -degrees);
  double most = 0;
  for (int k = 0; k < 3; ++k) {
    const double lean = softness.shear * (r.cwiseAbs().sum() - std::abs(r[k]));
    const auto [low, high] = std::minmax({softness.compression * r[k], softness.stretch * r[k]});
    most = std::max({most, low - lean - x[k], x[k] - high - lean});
  }
  return most;
}

/// The object of a simulation.
struct ObjectFacts {
  explicit ObjectFacts(const Simulation& simulation)
      : mesh(simulation.mesh_pointer()),
        pins(simulation.body().pins().begin(), simulation.body().pins().end()),
        softness(simulation.body().shared_softness()) {
    for (const LinkId link : simulation.body().cuts().links()) {
      cuts.insert(mesh->links[link]);
    }
    for (ElementId e = 0; e < mesh->element_count(); ++e) {
      positions.push_back(position_of(simulation, e));
    }
  }

  /// Returns the largest excess over the regions of all links that are not cut, except those inside a handle.
  double largest_excess(const std::set<ElementId>& handle) const {
    const Point& turn = softness->axes.rotation();  // about z in these tests
    double most = 0;
    for (LinkId link = 0; link < mesh->link_count(); ++link) {
      const auto [a, b] = mesh->links[link];
      if (!cuts.contains({a, b}) && !(handle.contains(a) && handle.contains(b))) {
        most = std::max(most, link_excess(mesh->rest_position(b) - mesh->rest_position(a), positions[b] - positions[a],
                                          softness->of(link), turn.z() * 180 / std::numbers::pi));
      }
    }
    return most;
  }

  MeshPointer mesh;
  std::set<Ends> cuts;
  std::set<ElementId> pins;
  std::shared_ptr<const Softness> softness;
  std::vector<Point> positions;
};

/// Returns what differs between two objects; empty if nothing does. Elements of `free` may be anywhere. Positions may
/// differ by the rounding of a change between positions and displacements.
inline std::string difference(const ObjectFacts& found, const ObjectFacts& expected,
                              const std::set<ElementId>& free = {}) {
  constexpr double rounding = 1e-9;
  if (found.mesh != expected.mesh || found.positions.size() != expected.positions.size()) {
    return "another mesh";
  }
  if (found.cuts != expected.cuts || found.pins != expected.pins) {
    return found.pins != expected.pins ? "pins" : "cuts";
  }
  if (!(*found.softness == *expected.softness)) {
    return "softness";
  }
  for (ElementId e = 0; e < expected.positions.size(); ++e) {
    if (!free.contains(e) && !((found.positions[e] - expected.positions[e]).norm() <= rounding)) {
      return "position of element " + std::to_string(e);
    }
  }
  return {};
}

/// Carries out commands on a simulation, and finds what does not follow from them. Rotations must be about z.
class FollowedSimulation {
 public:
  explicit FollowedSimulation(Simulation& simulation) : simulation_(simulation), expected_(simulation) {}

  /// Returns what is wrong after a command; empty if nothing is.
  std::string apply(const Command& command) {
    const ObjectFacts before(simulation_);
    const Algorithm algorithm_before = simulation_.statistics().algorithm;
    const bool must_refuse = is_refused(command);
    was_valid_ = before.largest_excess({}) <= rounding;
    expected_ = before;
    free_.clear();
    try {
      simulation_.apply(command);
    } catch (const Error&) {
      return with("refused", still_the_same(before, algorithm_before));
    }
    if (must_refuse) {
      return "accepted";
    }
    std::visit([this](const auto& one) { expect(one); }, command);
    const ObjectFacts after(simulation_);
    if (const std::string what = difference(after, expected_, free_); !what.empty()) {
      return what;
    }
    if (!std::ranges::equal(simulation_.grabbed(), held_)) {
      return "handle";
    }
    return rules(command, after);
  }

 private:
  static constexpr double rounding = 1e-9;  // mesh units

  static std::string with(const std::string& when, const std::string& what) {
    return what.empty() ? what : when + ": " + what;
  }
  std::string still_the_same(const ObjectFacts& before, Algorithm algorithm) const {
    return simulation_.statistics().algorithm != algorithm     ? "algorithm"
           : !std::ranges::equal(simulation_.grabbed(), held_) ? "handle"
                                                               : difference(ObjectFacts(simulation_), before);
  }
  /// Rules that are not about single commands.
  std::string rules(const Command& command, const ObjectFacts& after) const {
    if (count_parts(*after.mesh, simulation_.body().cuts()) != LinkedParts(*after.mesh, after.cuts).count()) {
      return "number of parts";
    }
    const AlgorithmInfo& algorithm = info(simulation_.statistics().algorithm);
    const bool drags = is_one_of<commands::Drag>(command);
    const bool relaxes = is_one_of<commands::Relax, commands::Relaxed>(command) && algorithm.relaxes();
    if (((drags && algorithm.holds_links) || (relaxes && was_valid_)) && after.largest_excess(held_) > rounding) {
      return "a link outside its region by " + std::to_string(after.largest_excess(held_));
    }
    return simulation_.valid() && after.largest_excess({}) > 1e-6 ? "said to be valid" : "";
  }

  // What must be refused, before the command.
  bool is_refused(const Command& command) const {
    using namespace commands;
    const auto pinned = [this](ElementId e) { return expected_pins().contains(e); };
    if (const auto* grab = std::get_if<Grab>(&command)) {
      return std::ranges::any_of(grab->elements, pinned);
    }
    if (const auto* pin = std::get_if<Pin>(&command)) {
      return std::ranges::any_of(pin->elements, [this](ElementId e) { return held_.contains(e); });
    }
    if (const auto* split = std::get_if<commands::Split>(&command)) {
      return split->split->before() != simulation_.mesh_pointer();
    }
    const auto* restored = std::get_if<RestoreState>(&command);
    return (is_one_of<Drag>(command) && held_.empty()) || (restored != nullptr && !kept_.contains(restored->state));
  }
  std::set<ElementId> expected_pins() const {
    return {simulation_.body().pins().begin(), simulation_.body().pins().end()};
  }

  void let_go() { held_.clear(); }
  void hold(std::set<ElementId> elements) {
    held_ = std::move(elements);
    start_ = {};
    pivot_ = Point::Zero();
    for (const ElementId e : held_) {
      start_[e] = expected_.positions[e];
      pivot_ += expected_.positions[e] / double(held_.size());
    }
  }
  /// All elements may move, except the handle and the pins.
  void free_all() {
    for (ElementId e = 0; e < expected_.positions.size(); ++e) {
      if (!held_.contains(e) && !expected_.pins.contains(e)) {
        free_.insert(e);
      }
    }
  }
  void set(std::vector<Point> positions) { expected_.positions = std::move(positions); }

  void expect(const commands::Grab& command) { hold({command.elements.begin(), command.elements.end()}); }
  void expect(const commands::Drag& command) {
    const double sense = command.rotation.axis.z() < 0 ? -1 : 1;
    const Point to = command.relative ? Point(pivot_ + command.target) : command.target;
    free_all();
    if (simulation_.statistics().last_pass.stopped) {
      free_.insert(held_.begin(), held_.end());
    }
    for (const auto& [e, from] : start_) {
      expected_.positions[e] = to + turned_about_z(from - pivot_, sense * command.rotation.degrees);
    }
    if (info(simulation_.statistics().algorithm).family() == Family::chainmail) {  // nothing pulls a part cut off
      const LinkedParts parts(*expected_.mesh, expected_.cuts);
      std::erase_if(free_, [&](ElementId e) {
        return std::ranges::none_of(held_, [&](ElementId one) { return parts.of(one) == parts.of(e); });
      });
    }
  }
  void expect(const commands::Release&) { let_go(); }
  void expect(const commands::SetSoftness& command) {
    expected_.softness = command.softness;
    answer();
  }
  void expect(const commands::SetRelaxation&) {}
  void expect(const commands::Relax& command) {
    free_all();
    if (command.scheme == RelaxationScheme::equilibrium && !was_valid_) {  // the handle may contradict the pins
      free_.insert(held_.begin(), held_.end());
    }
  }
  void expect(const commands::Relaxed&) { free_all(); }
  void expect(const commands::SetElastic&) { answer(); }
  void expect(const commands::SetAlgorithm& command) {
    answer();
    if (simulation_.statistics().algorithm != command.algorithm) {
      expected_.mesh = nullptr;  // differs from any
    }
  }
  /// A setting makes the last handle answer again, where it is.
  void answer() {
    free_all();
    if (simulation_.statistics().last_pass.stopped) {
      free_.insert(held_.begin(), held_.end());
    }
  }
  void expect(const commands::Cut& command) {
    for (const LinkId link : command.links) {
      expected_.cuts.insert(expected_.mesh->links[link]);
    }
  }
  void expect(const commands::Uncut& command) {
    for (const LinkId link : command.links) {
      expected_.cuts.erase(expected_.mesh->links[link]);
    }
  }
  void expect(const commands::Pin& command) { expected_.pins.insert(command.elements.begin(), command.elements.end()); }
  void expect(const commands::Unpin& command) {
    for (const ElementId e : command.elements) {
      expected_.pins.erase(e);
    }
  }
  void expect(const commands::Reset&) {
    set(rest_of(*expected_.mesh));
    hold(held_);
  }
  void expect(const commands::ReplaceMesh& command) {
    expected_.mesh = command.mesh;
    expected_.cuts.clear();
    expected_.pins.clear();
    Softness kept = *expected_.softness;
    kept.links = {};
    expected_.softness = std::make_shared<const Softness>(kept);
    set(rest_of(*command.mesh));
    let_go();
  }
  void expect(const commands::SetPositions& command) {
    std::vector<Point> positions = rest_of(*expected_.mesh);
    const PositionRuns given = runs_of(*command.snapshot, *expected_.mesh);
    std::size_t at = 0;
    for (std::size_t run = 0; run + 1 < given.runs.size(); run += 2) {
      for (ElementId e = given.runs[run]; e < given.runs[run + 1]; ++e) {
        for (int k = 0; k < expected_.mesh->space_dimension; ++k) {
          positions[e][expected_.mesh->axes[std::size_t(k)]] = given.held[at++];
        }
      }
    }
    set(std::move(positions));
    let_go();
  }
  void expect(const commands::KeepState& command) { kept_.insert_or_assign(command.state, expected_); }
  void expect(const commands::RestoreState& command) {
    expected_ = kept_.at(command.state);
    let_go();
  }
  void expect(const commands::DropState& command) { kept_.erase(command.state); }
  /// A split that puts one element into a triangle: three more links, all inside it, and two more triangles.
  void expect(const commands::Split& command) {
    const MeshPointer divided = command.split->after();
    const Mesh &old = *expected_.mesh, &now = *divided;
    const bool has_grown = now.element_count() == old.element_count() + 1 && now.link_count() == old.link_count() + 3 &&
                           now.triangles.size() == old.triangles.size() + 2;
    const auto& [of, shares] = command.split->edit().elements.front();
    const auto& at = expected_.positions;
    const Point inside = (1 - shares[0] - shares[1]) * at[of[0]] + shares[0] * at[of[1]] + shares[1] * at[of[2]];
    expected_.positions.push_back(inside);
    // A triangle with a cut side is gone, and its pieces stay gone. The new element keeps one link.
    std::array<ElementId, 3> corner = old.triangles[command.split->edit().removed.front()];
    std::ranges::sort(corner);
    const auto& [a, b, c] = corner;
    if (expected_.cuts.contains({a, b}) || expected_.cuts.contains({b, c}) || expected_.cuts.contains({a, c})) {
      expected_.cuts.insert({{b, old.element_count()}, {c, old.element_count()}});
    }
    expected_.mesh = has_grown ? divided : nullptr;
    expected_.softness = simulation_.body().shared_softness();  // the links are numbered anew
    let_go();
  }

  static std::vector<Point> rest_of(const Mesh& mesh) {
    std::vector<Point> rest;
    for (ElementId e = 0; e < mesh.element_count(); ++e) {
      rest.push_back(mesh.rest_position(e));
    }
    return rest;
  }

  Simulation& simulation_;
  ObjectFacts expected_;
  bool was_valid_ = true;     // all links, before the command
  std::set<ElementId> free_;  // may have moved anywhere
  std::set<ElementId> held_;
  std::map<ElementId, Point> start_;  // where the held elements were grabbed
  Point pivot_ = Point::Zero();
  std::map<commands::StateId, ObjectFacts> kept_;
};

}  // namespace chainmail::test
