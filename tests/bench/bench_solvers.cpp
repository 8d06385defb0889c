// What passes take, each figure a ratio within one run: bench_solvers RESULTS (README.md says what each is).

#include <algorithm>
#include <cstdio>

#include "bench/contestants.h"
#include "bench/layout.h"
#include "bench/results.h"

namespace chainmail::bench {
namespace {

using names::exact;
using names::natural_queue;
using names::without_replay;

/// The time per moved element of one over that of another.
double over(const Run& one, const Run& other) { return one.ns_per_moved() / other.ns_per_moved(); }

void against_2004(Results& results) {
  const Scene scene("grid64");
  const auto runs = run({dragged(scene, natural_queue, Drag::whole_body), dragged_as_2004(scene)});
  results.add(runs);
  results.ratios()["vs_2004"] = over(of(runs, names::of_2004), of(runs, natural_queue));
}

/// Also gives Exact's ratio on these two meshes.
double against_floor(Results& results) {
  double largest = 0;
  for (const char* mesh : {"grid1024", "block100"}) {
    const Scene scene(mesh);
    const auto runs = run({streamed(scene), dragged(scene, natural_queue, Drag::whole_body),
                           dragged(scene, without_replay, Drag::whole_body), dragged(scene, exact, Drag::whole_body),
                           dragged(scene, names::exact_anew, Drag::whole_body)});
    results.add(runs);
    results.ratios()["vs_floor"][mesh] = over(of(runs, natural_queue), of(runs, names::memory_floor));
    largest = std::max(largest, over(of(runs, exact), of(runs, without_replay)));
  }
  return largest;
}

void growth(Results& results) {
  const Scene small("grid64"), large("grid2048");
  for (const auto& [drag, key] : {std::pair(Drag::whole_body, "per_element"), std::pair(Drag::local, "local")}) {
    std::vector<Contestant> contest;
    for (const Scene* scene : {&small, &large}) {
      contest.push_back(dragged(*scene, natural_queue, drag));
      contest.push_back(dragged(*scene, exact, drag));
    }
    const auto runs = run(contest);
    results.add(runs);
    const Run &much = of(runs, natural_queue, large.name), &little = of(runs, natural_queue, small.name);
    results.ratios()["growth"][key] = drag == Drag::local ? much.ms / little.ms : over(much, little);
  }
}

/// Exact over Natural Queue: the worst of these meshes.
double exact_over(Results& results, Drag drag, const std::vector<std::string>& meshes) {
  double largest = 0;
  for (const std::string& mesh : meshes) {
    const Scene scene(mesh);
    const auto runs = run(
        {dragged(scene, without_replay, drag), dragged(scene, exact, drag), dragged(scene, names::exact_anew, drag)});
    results.add(runs);
    largest = std::max(largest, over(of(runs, exact), of(runs, without_replay)));
  }
  return largest;
}

/// A scene in the plane beside the same one in space.
void plane(Results& results) {
  const Scene flat("grid1024"), in_space("grid1024_3d");
  const auto runs =
      run({dragged(flat, natural_queue, Drag::whole_body), dragged(in_space, natural_queue, Drag::whole_body)});
  results.add(runs);
  results.ratios()["plane"] = {
      {"time", over(of(runs, natural_queue, flat.name), of(runs, natural_queue, in_space.name))},
      {"bytes", double(state_bytes(*flat.mesh)) / double(state_bytes(*in_space.mesh))}};
}

/// What stands in the table alone: local drags on the other meshes, and what Generalized takes.
void others(Results& results) {
  for (const char* mesh : {"cloth512", "block100", "jittered_tetra60"}) {
    const Scene scene(mesh);
    results.add(run({dragged(scene, natural_queue, Drag::local), dragged(scene, exact, Drag::local)}));
  }
  const Scene scene("cloth512");
  results.add(run({dragged(scene, "generalized", Drag::whole_body), dragged(scene, natural_queue, Drag::whole_body),
                   dragged(scene, exact, Drag::whole_body)}));
}

void measure(Results& results) {
  against_2004(results);
  const double uniform = against_floor(results);
  growth(results);
  auto& exactly = results.ratios()["exact_over_nq"];
  exactly["uniform"] = std::max(uniform, exact_over(results, Drag::whole_body, {"grid256"}));
  exactly["jittered"] =
      exact_over(results, Drag::whole_body, {"jittered_grid1024", "jittered_cloth512", "jittered_tetra60", "tetra60"});
  exactly["mixed"] = exact_over(results, Drag::whole_body_mixed, {"grid1024", "jittered_tetra60"});
  plane(results);
  others(results);
}

}  // namespace
}  // namespace chainmail::bench

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "bench_solvers: name the file of results, as in: bench_solvers build/bench.json\n");
    return 2;
  }
  chainmail::bench::Results results(argv[1]);
  chainmail::bench::measure(results);
  results.write();
}
