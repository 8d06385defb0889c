// Exact ChainMail's schedules beside Natural Queue on the same moves: whole-body drags in float.
// README.md in this folder has the table.

#include <benchmark/benchmark.h>

#include "bench/schedules.h"
#include "core/families.h"
#include "solve/exact.h"
#include "solve/propagate.h"

namespace chainmail {
namespace {

using namespace bench;

constexpr LinkSoftness stiff{0.999, 1.001, 0.0005};

struct Case {
  const char* name;
  MeshPointer mesh;
  Softness softness;
};

MeshPointer jittered_block(std::uint32_t side) {
  std::mt19937_64 random(5);
  const auto block = generate({MeshKind::tetra, {side, side, side}, 1, {}});
  return build_mesh(test::placed(*block, [&](const Point& p) {
    return Point(p[0] + test::uniform(random, -0.3, 0.3), p[1] + test::uniform(random, -0.3, 0.3),
                 p[2] + test::uniform(random, -0.3, 0.3));
  }));
}

/// Each link as stiff as any other, up to 200 times.
Softness mixed(const Mesh& mesh) {
  std::mt19937_64 random(7);
  Softness softness{stiff, {}};
  for (LinkId link = 0; link < mesh.link_count(); ++link) {
    const double give = 1e-4 * std::pow(200, test::uniform(random, 0, 1));
    softness.links.emplace_hint(softness.links.end(), link, LinkSoftness{1 - give, 1 + give, give / 2});
  }
  return softness;
}

const std::vector<Case>& cases() {
  static const std::vector<Case> all = [] {
    const auto grid = generate({MeshKind::grid, {256, 256, 1}, 1, {}});
    const auto cloth = test::jittered_triangles(256, 256, 1);
    const auto block = generate({MeshKind::block, {40, 40, 40}, 1, {}});
    const auto tetra = jittered_block(40);
    return std::vector<Case>{{"grid256", grid, {stiff, {}}},
                             {"block40", block, {stiff, {}}},
                             {"jittered_cloth256", cloth, {stiff, {}}},
                             {"jittered_tetra40", tetra, {stiff, {}}},
                             {"grid256_mixed", grid, mixed(*grid)},
                             {"jittered_tetra40_mixed", tetra, mixed(*tetra)}};
  }();
  return all;
}

/// Every second move goes there, the others back: beyond what the links give over the whole object.
template <int Dimension, class Pass>
void drag(benchmark::State& state, const Case& of, bool from_rest, Pass pass) {
  Body<float, Dimension> body(of.mesh, from_rest);
  body.set_softness(of.softness);
  std::vector<ElementId> moved;
  const ElementId corner = 0;
  bool out = false;
  std::uint64_t visits = 0, passes = 0;
  for (auto _ : state) {
    out = !out;
    float target[Dimension];
    for (int k = 0; k < Dimension; ++k) {
      target[k] = static_cast<float>(of.mesh->rest[k] - body.origin(corner, k)) + (out ? 0.7f + 0.1f * k : 0) * 64;
    }
    visits += pass(body, corner, target, moved);
    ++passes;
  }
  const double elements = of.mesh->element_count();
  state.counters["moved"] = double(moved.size()) / elements;
  state.counters["visits"] = double(visits) / double(passes) / elements;
  state.counters["ns_per_element"] =
      benchmark::Counter(elements * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

template <int Dimension, class Schedule>
void exact(benchmark::State& state, const Case& of) {
  ExactPropagation<float, Dimension, Schedule> propagation;
  drag<Dimension>(state, of, true, [&](auto& body, ElementId grabbed, auto& target, auto& moved) {
    return propagation.propagate(body, {}, grabbed, target, moved, nullptr).visits;
  });
}

template <int Dimension>
void natural_queue(benchmark::State& state, const Case& of) {
  NaturalQueueList list;
  drag<Dimension>(state, of, false, [&](auto& body, ElementId grabbed, auto& target, auto& moved) {
    std::copy(std::begin(target), std::end(target), body.places[grabbed].at);
    return propagate(body, list, grabbed, moved, [](ElementId, ElementId, bool) {});
  });
}

template <int Dimension>
void add(const Case& of) {
  const std::string name = of.name;
  const auto add_one = [&](const std::string& which, auto function) {
    benchmark::RegisterBenchmark((name + "/" + which).c_str(), function, of)->Unit(benchmark::kMillisecond);
  };
  add_one("natural_queue", [](benchmark::State& s, const Case& c) { natural_queue<Dimension>(s, c); });
  add_one("adaptive", [](benchmark::State& s, const Case& c) { exact<Dimension, AdaptiveSchedule<float>>(s, c); });
  add_one("radix_heap", [](benchmark::State& s, const Case& c) { exact<Dimension, RadixHeapSchedule<float>>(s, c); });
  for (const double width : {0.0003, 0.003}) {
    add_one("steps_of_" + std::to_string(width).substr(0, 6), [width](benchmark::State& s, const Case& c) {
      StepSchedule<float>::width = width;
      exact<Dimension, StepSchedule<float>>(s, c);
    });
  }
  add_one("heap", [](benchmark::State& s, const Case& c) { exact<Dimension, HeapSchedule<float>>(s, c); });
  add_one("fifo", [](benchmark::State& s, const Case& c) { exact<Dimension, FifoSchedule<float>>(s, c); });
  add_one("buckets_1024",
          [](benchmark::State& s, const Case& c) { exact<Dimension, BucketSchedule<float, 1024>>(s, c); });
  add_one("buckets_16384",
          [](benchmark::State& s, const Case& c) { exact<Dimension, BucketSchedule<float, 16384>>(s, c); });
}

}  // namespace
}  // namespace chainmail

int main(int argc, char** argv) {
  for (const auto& of : chainmail::cases()) {
    of.mesh->space_dimension == 2 ? chainmail::add<2>(of) : chainmail::add<3>(of);
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
