#include "bench/contestants.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>

#include "bench/layout.h"
#include "bench/textbook.h"
#include "reference/chainmail.h"
#include "report/run/scripted_drags.h"

namespace chainmail::bench {
namespace {

/// The handle on its closed path.
struct Round {
  DragPath path;
  std::size_t next = 0;

  const Point& step() {
    const Point& target = path.targets[next];
    next = (next + 1) % path.targets.size();
    return target;
  }
};

bool is_without_memory(const std::string& algorithm) {
  return algorithm == names::without_replay || algorithm == names::exact_anew || algorithm == names::exact_anew_threads;
}

std::unique_ptr<Deformer> make(const MeshPointer& mesh, const std::string& algorithm) {
  const bool is_shared = algorithm == names::exact_threads || algorithm == names::exact_anew_threads;
  const auto which = algorithm == names::without_replay            ? Algorithm::natural_queue
                     : algorithm == names::exact_anew || is_shared ? Algorithm::exact
                                                                   : find_algorithm(algorithm).value();
  auto solver = std::make_unique<Deformer>(mesh, which, Precision::single_precision);
  solver->set_threads(is_shared ? 2 : 1);
  return solver;
}

/// Returns the number of warm-up passes: two rounds of a local drag. A whole-body drag needs fewer, because its passes
/// are all alike.
std::size_t warm_up(Drag drag, const DragPath& path) { return drag == Drag::local ? 2 * path.targets.size() : 4; }

int passes(Drag drag, std::uint64_t elements) {
  return drag == Drag::local ? 1024 : std::clamp(2'000'000 / int(elements), 2, 400);
}

/// Throws if fewer than 95 % of the elements moved. Generalized does not move all: some are already in their valid
/// regions.
void check_whole(std::uint64_t moved, const Mesh& mesh) {
  if (double(moved) < 0.95 * mesh.element_count()) {
    throw std::logic_error("a whole-body drag moved " + std::to_string(moved) + " elements of " +
                           std::to_string(mesh.element_count()));
  }
}

/// Throws if the solver and the textbook version differ after the same drag.
void check_textbook(const MeshPointer& mesh, Textbook<float, 2>& textbook) {
  const auto solver = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, Precision::single_precision);
  solver->body().set_softness({stiff, {}});
  const DragPath path = path_of(Drag::whole_body, *mesh);
  for (const Point& target : path.targets) {
    solver->move(path.element, target);
    textbook.move(path.element, target);
  }
  std::vector<float> positions(std::size_t{mesh->element_count()} * 2);
  solver->body().copy_positions(positions);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (positions[i] != textbook.positions()[i / 2][i % 2]) {
      throw std::logic_error("the textbook version and the solver disagree at element " + std::to_string(i / 2));
    }
  }
}

struct Copy {
  explicit Copy(const PassBytes& bytes)
      : updated(bytes.updated / 4, 1), read(bytes.read / 4, 1), written(bytes.written / 4, 1) {}

  void touch(std::uint32_t pass) {
    for (std::uint32_t& word : updated) {
      ++word;
    }
    auto sum = std::accumulate(read.begin(), read.end(), std::uint32_t{0});
    benchmark::DoNotOptimize(sum);
    std::fill(written.begin(), written.end(), pass);
    benchmark::DoNotOptimize(written.data());
    benchmark::DoNotOptimize(updated.data());
    benchmark::ClobberMemory();
  }

  std::vector<std::uint32_t> updated, read, written;
};

}  // namespace

Contestant dragged(const Scene& scene, const std::string& algorithm, Drag drag) {
  const std::shared_ptr<Deformer> solver = make(scene.mesh, algorithm);
  solver->body().set_softness(softness(drag, *scene.mesh));
  const auto round = std::make_shared<Round>(Round{path_of(drag, *scene.mesh)});
  const auto pass = [solver, round, drag, mesh = scene.mesh, anew = is_without_memory(algorithm)] {
    if (anew) {
      solver->body().cut({});  // the solver assumes other links and forgets all data of the last pass
    }
    const std::uint64_t moved = solver->move(round->path.element, round->step()).moved;
    if (drag != Drag::local) {
      check_whole(moved, *mesh);
    }
    return moved;
  };
  for (std::size_t i = 0; i < warm_up(drag, round->path); ++i) {
    pass();
  }
  const std::uint64_t elements = scene.mesh->element_count();
  return {name(drag), scene.name, algorithm, elements, passes(drag, elements), pass};
}

Contestant dragged_as_2004(const Scene& scene) {
  const auto object = std::make_shared<reference::Object<float>>(scene.mesh, [](ElementId, ElementId) {
    return reference::Factors{stiff.compression, stiff.stretch, stiff.shear};
  });
  const auto round = std::make_shared<Round>(Round{path_of(Drag::whole_body, *scene.mesh)});
  const auto pass = [object, round, mesh = scene.mesh] {
    const Point& to = round->step();
    const auto processed =
        reference::move<reference::NaturalQueueChainMail>(*object, {{round->path.element, {to[0], to[1], to[2]}}});
    const auto moved = std::count_if(processed.begin(), processed.end(), [](const auto& one) { return one.moved; });
    check_whole(std::uint64_t(moved), *mesh);
    return std::uint64_t(moved);
  };
  return {name(Drag::whole_body), scene.name, names::of_2004, scene.mesh->element_count(), 1, pass};
}

Contestant dragged_by_textbook(const Scene& scene) {
  const auto object = std::make_shared<Textbook<float, 2>>(scene.mesh, stiff);
  check_textbook(scene.mesh, *object);
  const auto round = std::make_shared<Round>(Round{path_of(Drag::whole_body, *scene.mesh)});
  const auto pass = [object, round, mesh = scene.mesh] {
    const std::uint64_t moved = object->move(round->path.element, round->step());
    check_whole(moved, *mesh);
    return moved;
  };
  const std::uint64_t elements = scene.mesh->element_count();
  return {name(Drag::whole_body), scene.name, names::textbook, elements, passes(Drag::whole_body, elements), pass};
}

Contestant streamed(const Scene& scene, const std::string& algorithm) {
  const PassBytes bytes = algorithm == names::exact_bytes ? exact_bytes(*scene.mesh) : replay_bytes(*scene.mesh);
  const auto copies = std::make_shared<std::vector<Copy>>(held_bytes(*scene.mesh) / bytes.all() + 1, Copy(bytes));
  const std::uint64_t elements = scene.mesh->element_count();
  const auto pass = [copies, elements, next = std::size_t{0}]() mutable {
    (*copies)[next % copies->size()].touch(std::uint32_t(next));
    ++next;
    return elements - 1;
  };
  return {name(Drag::whole_body), scene.name, algorithm, elements, passes(Drag::whole_body, elements), pass};
}

double sweep_nanoseconds(const Scene& scene) {
  using Clock = std::chrono::steady_clock;
  constexpr int measured_sweeps = 9;
  const std::unique_ptr<Deformer> solver = make(scene.mesh, names::natural_queue);
  Softness soft;
  soft.energy = EnergyKind::isotropic;
  solver->body().set_softness(soft);
  const DragPath path = path_of(Drag::whole_body, *scene.mesh);
  for (std::size_t i = 0; i < warm_up(Drag::whole_body, path); ++i) {
    solver->move(path.element, path.targets[i]);
  }
  std::vector<double> nanoseconds;
  for (int i = 0; i < measured_sweeps; ++i) {
    solver->wake_all();
    const auto begin = Clock::now();
    const std::uint64_t visited = solver->relax_slice(1, std::numeric_limits<std::uint64_t>::max(), {}).visited;
    nanoseconds.push_back(std::chrono::duration<double, std::nano>(Clock::now() - begin).count() / double(visited));
  }
  return median(nanoseconds);
}

HandLike hand_like_drags(const Scene& scene, const std::string& algorithm) {
  using Clock = std::chrono::steady_clock;
  const std::unique_ptr<Deformer> solver = make(scene.mesh, algorithm);
  std::vector<double> ms;
  double sum = 0;
  std::uint64_t moved = 0;
  for (const report::ScriptedDrag& drag : report::scripted_drags(*scene.mesh, 2004, 6, 60)) {
    solver->body().reset();
    for (const Point& target : drag.targets) {
      const auto begin = Clock::now();
      moved += solver->move(drag.element, target).moved;
      ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
      sum += ms.back();
    }
  }
  return {1e6 * sum / double(moved), median(ms), *std::max_element(ms.begin(), ms.end())};
}

}  // namespace chainmail::bench
