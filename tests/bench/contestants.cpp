#include "bench/contestants.h"

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace chainmail::bench {
namespace {

/// A solver and the hand that drags it.
struct Dragged {
  std::unique_ptr<Solver> solver;
  Hand hand;
  std::size_t next = 0;

  std::uint64_t pass() {
    const Point& target = hand.targets[next];
    next = (next + 1) % hand.targets.size();
    return solver->move(hand.element, target).moved;
  }
};

std::unique_ptr<Solver> make(const MeshPointer& mesh, const std::string& algorithm) {
  if (algorithm == natural_queue_without_replay) {
    return make_solver(mesh, Algorithm::natural_queue, Precision::single_precision);
  }
  return make_solver(mesh, find_algorithm(algorithm).value(), Precision::single_precision);
}

/// A whole round of a local drag; of a whole body, whose passes are all alike, less.
std::size_t warm_up(Drag drag, const Hand& hand) { return drag == Drag::local ? 2 * hand.targets.size() : 4; }

}  // namespace

Contestant dragged(const MeshPointer& mesh, const std::string& algorithm, Drag drag) {
  const auto one = std::make_shared<Dragged>(Dragged{make(mesh, algorithm), hand(drag, *mesh), 0});
  one->solver->set_softness(softness(drag, *mesh));
  const bool whole = drag != Drag::local;
  const auto pass = [one, whole, others = mesh->element_count() - 1] {
    const std::uint64_t moved = one->pass();
    if (whole && moved != others) {
      throw std::logic_error("the whole-body drag moved " + std::to_string(moved) + " of " + std::to_string(others));
    }
    return moved;
  };
  for (std::size_t i = 0; i < warm_up(drag, one->hand); ++i) {
    pass();
  }
  return {algorithm, pass};
}

Contest contest(Drag drag, const std::string& mesh_name, const MeshPointer& mesh,
                const std::vector<std::string>& algorithms) {
  Contest made{name(drag), mesh_name, mesh->element_count(), 0, {}};
  made.passes = drag == Drag::local ? 1024 : std::clamp(2'000'000 / int(mesh->element_count()), 2, 400);
  for (const std::string& algorithm : algorithms) {
    made.contestants.push_back(dragged(mesh, algorithm, drag));
  }
  return made;
}

}  // namespace chainmail::bench
