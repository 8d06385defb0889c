#include "bench/contestants.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <stdexcept>

#include "bench/layout.h"
#include "reference/chainmail.h"

namespace chainmail::bench {
namespace {

/// A hand on its round.
struct Round {
  Hand hand;
  std::size_t next = 0;

  const Point& step() {
    const Point& target = hand.targets[next];
    next = (next + 1) % hand.targets.size();
    return target;
  }
};

bool is_without_memory(const std::string& algorithm) {
  return algorithm == names::without_replay || algorithm == names::exact_anew;
}

std::unique_ptr<Solver> make(const MeshPointer& mesh, const std::string& algorithm) {
  const auto which = algorithm == names::without_replay ? Algorithm::natural_queue
                     : algorithm == names::exact_anew   ? Algorithm::exact
                                                        : find_algorithm(algorithm).value();
  return make_solver(mesh, which, Precision::single_precision);
}

/// Two rounds of a local drag; of a whole body, whose passes are all alike, less.
std::size_t warm_up(Drag drag, const Hand& hand) { return drag == Drag::local ? 2 * hand.targets.size() : 4; }

int passes(Drag drag, std::uint64_t elements) {
  return drag == Drag::local ? 1024 : std::clamp(2'000'000 / int(elements), 2, 400);
}

/// Generalized passes some elements by that stand within their regions about the sponsor it came from.
void check_whole(std::uint64_t moved, const Mesh& mesh) {
  if (double(moved) < 0.95 * mesh.element_count()) {
    throw std::logic_error("a whole-body drag moved " + std::to_string(moved) + " elements of " +
                           std::to_string(mesh.element_count()));
  }
}

}  // namespace

Contestant dragged(const Scene& scene, const std::string& algorithm, Drag drag) {
  const std::shared_ptr<Solver> solver = make(scene.mesh, algorithm);
  solver->set_softness(softness(drag, *scene.mesh));
  const auto round = std::make_shared<Round>(Round{hand(drag, *scene.mesh)});
  const auto pass = [solver, round, drag, mesh = scene.mesh, anew = is_without_memory(algorithm)] {
    if (anew) {
      solver->cut({});  // other links, as far as it knows: what the last pass learnt is forgotten
    }
    const std::uint64_t moved = solver->move(round->hand.element, round->step()).moved;
    if (drag != Drag::local) {
      check_whole(moved, *mesh);
    }
    return moved;
  };
  for (std::size_t i = 0; i < warm_up(drag, round->hand); ++i) {
    pass();
  }
  const std::uint64_t elements = scene.mesh->element_count();
  return {name(drag), scene.name, algorithm, elements, passes(drag, elements), pass};
}

Contestant dragged_as_2004(const Scene& scene) {
  const auto object = std::make_shared<reference::Object<float>>(scene.mesh, [](ElementId, ElementId) {
    return reference::Factors{stiff.compression, stiff.stretch, stiff.shear};
  });
  const auto round = std::make_shared<Round>(Round{hand(Drag::whole_body, *scene.mesh)});
  const auto pass = [object, round, mesh = scene.mesh] {
    const Point& to = round->step();
    const auto processed =
        reference::move<reference::NaturalQueueChainMail>(*object, round->hand.element, {to[0], to[1], to[2]});
    const auto moved = std::count_if(processed.begin(), processed.end(), [](const auto& one) { return one.moved; });
    check_whole(std::uint64_t(moved), *mesh);
    return std::uint64_t(moved);
  };
  return {name(Drag::whole_body), scene.name, names::of_2004, scene.mesh->element_count(), 1, pass};
}

Contestant streamed(const Scene& scene) {
  struct Copy {
    std::vector<std::uint32_t> state, table;
  };
  const PassBytes bytes = pass_bytes(*scene.mesh);
  const std::size_t held = state_bytes(*scene.mesh) + bytes.table;
  const auto copies = std::make_shared<std::vector<Copy>>(
      held / (bytes.state + bytes.table) + 1,
      Copy{std::vector<std::uint32_t>(bytes.state / 4, 1), std::vector<std::uint32_t>(bytes.table / 4, 1)});
  const std::uint64_t elements = scene.mesh->element_count();
  const auto pass = [copies, elements, next = std::size_t{0}]() mutable {
    Copy& copy = (*copies)[next++ % copies->size()];
    for (std::uint32_t& word : copy.state) {
      ++word;
    }
    benchmark::DoNotOptimize(copy.state.data());
    benchmark::ClobberMemory();
    auto sum = std::accumulate(copy.table.begin(), copy.table.end(), std::uint32_t{0});
    benchmark::DoNotOptimize(sum);
    return elements - 1;
  };
  return {name(Drag::whole_body), scene.name, names::memory_floor, elements, passes(Drag::whole_body, elements), pass};
}

}  // namespace chainmail::bench
