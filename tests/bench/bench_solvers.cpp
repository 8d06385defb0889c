// Measures times of passes. Each figure is a ratio within one run (see README.md): bench_solvers RESULTS.

#include <algorithm>
#include <array>
#include <cstdio>

#include "bench/contestants.h"
#include "bench/results.h"

namespace chainmail::bench {
namespace {

using names::exact;
using names::natural_queue;
using names::without_replay;

/// Returns the time per moved element of one run divided by that of another.
double over(const Run& one, const Run& other) { return one.ns_per_moved() / other.ns_per_moved(); }

/// Compares the textbook version and the version of the thesis with the solver.
void against_textbook(Results& results) {
  const Scene scene("grid64");
  const auto runs =
      run({dragged(scene, natural_queue, Drag::whole_body), dragged(scene, without_replay, Drag::whole_body),
           dragged_by_textbook(scene), dragged_as_2004(scene)});
  results.add(runs);
  results.add("/vs_textbook", over(of(runs, names::textbook), of(runs, natural_queue)));
  results.add("/vs_textbook_first", over(of(runs, names::textbook), of(runs, without_replay)));
  results.add("/vs_2004", over(of(runs, names::of_2004), of(runs, natural_queue)));
}

/// Compares later passes with the time to touch their bytes once.
void against_memory(Results& results) {
  for (const std::string mesh : {"grid1024", "block100"}) {
    const Scene scene(mesh);
    const auto runs = run({streamed(scene, names::natural_queue_bytes), streamed(scene, names::exact_bytes),
                           dragged(scene, natural_queue, Drag::whole_body), dragged(scene, exact, Drag::whole_body)});
    results.add(runs);
    results.add("/vs_floor/" + mesh, over(of(runs, natural_queue), of(runs, names::natural_queue_bytes)));
    results.add("/vs_floor_exact/" + mesh, over(of(runs, exact), of(runs, names::exact_bytes)));
  }
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
    results.add(std::string("/growth/") + key, drag == Drag::local ? much.ms / little.ms : over(much, little));
  }
}

/// Compares Exact with Natural Queue: first pass with first pass, and later passes with later passes. The result is the
/// worst of these meshes.
void exact_over(Results& results, const std::string& key, Drag drag, const std::vector<std::string>& meshes) {
  double first = 0, later = 0;
  for (const std::string& mesh : meshes) {
    const Scene scene(mesh);
    const auto runs = run({dragged(scene, without_replay, drag), dragged(scene, names::exact_anew, drag),
                           dragged(scene, natural_queue, drag), dragged(scene, exact, drag)});
    results.add(runs);
    first = std::max(first, over(of(runs, names::exact_anew), of(runs, without_replay)));
    later = std::max(later, over(of(runs, exact), of(runs, natural_queue)));
  }
  results.add("/exact_over_nq/first/" + key, first);
  results.add("/exact_over_nq/later/" + key, later);
}

/// Compares first passes on large meshes with those on small ones.
void first_passes(Results& results) {
  for (const auto& [small, large, key] : {std::array<std::string, 3>{"grid256", "grid1024", "plane"},
                                          std::array<std::string, 3>{"block40", "block100", "space"}}) {
    const Scene few(small), many(large);
    const auto runs =
        run({dragged(few, without_replay, Drag::whole_body), dragged(many, without_replay, Drag::whole_body),
             dragged(few, names::exact_anew, Drag::whole_body), dragged(many, names::exact_anew, Drag::whole_body)});
    results.add(runs);
    for (const auto& [algorithm, name] :
         {std::pair(without_replay, "natural_queue"), std::pair(names::exact_anew, "exact")}) {
      const Run &little = of(runs, algorithm, small), &much = of(runs, algorithm, large);
      const std::string place = std::string("/first_pass/") + name + "/";
      results.add(place + small, little.ns_per_moved());
      results.add(place + large, much.ns_per_moved());
      results.add(place + key, over(much, little));
    }
  }
}

/// Compares passes of Exact on two threads with those on one.
void threads(Results& results) {
  // Not grid1024: its rows are a power of two long, so that the rows that a front crosses share few places in the
  // cache.
  for (const std::string mesh : {"grid64", "grid1000", "block100", "jittered_tetra60"}) {
    const Scene scene(mesh);
    const auto runs =
        run({dragged(scene, names::exact_anew, Drag::whole_body),
             dragged(scene, names::exact_anew_threads, Drag::whole_body), dragged(scene, exact, Drag::whole_body),
             dragged(scene, names::exact_threads, Drag::whole_body)});
    results.add(runs);
    results.add("/threads/first/" + mesh, over(of(runs, names::exact_anew), of(runs, names::exact_anew_threads)));
    results.add("/threads/later/" + mesh, over(of(runs, exact), of(runs, names::exact_threads)));
  }
}

/// Measures sweeps over an object of which every element is active.
void sweeps(Results& results) {
  for (const std::string mesh : {"grid256", "tetra60"}) {
    const Scene scene(mesh);
    results.add("/sweep_ns/" + mesh, sweep_nanoseconds(scene));
  }
}

/// Compares a scene in the plane with the same scene in 3D space.
void plane(Results& results) {
  const Scene flat("grid1024"), in_space("grid1024_3d");
  const auto runs =
      run({dragged(flat, natural_queue, Drag::whole_body), dragged(in_space, natural_queue, Drag::whole_body)});
  results.add(runs);
  results.add("/plane/time", over(of(runs, natural_queue, flat.name), of(runs, natural_queue, in_space.name)));
}

/// Measures drags as a user makes them: each from rest, with the default softness. Every pass counts, also the first.
void hand_like(Results& results) {
  const Scene scene("grid1024");
  for (const auto& [algorithm, key] : {std::pair(natural_queue, "natural_queue"), std::pair(exact, "exact")}) {
    const HandLike times = hand_like_drags(scene, algorithm);
    const std::string place = std::string("/hand_like/") + key;
    results.add(place + "/ns_per_moved", times.ns_per_moved);
    results.add(place + "/median_ms", times.median_ms);
    results.add(place + "/worst_ms", times.worst_ms);
  }
}

/// Measures rows that only the table shows: local drags on the other meshes, and the times of Generalized.
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
  against_textbook(results);
  against_memory(results);
  growth(results);
  exact_over(results, "uniform", Drag::whole_body, {"grid256", "grid1024", "block100"});
  exact_over(results, "jittered", Drag::whole_body,
             {"jittered_grid1024", "jittered_cloth512", "jittered_tetra60", "tetra60"});
  exact_over(results, "mixed", Drag::whole_body_mixed, {"grid1024", "jittered_tetra60"});
  first_passes(results);
  threads(results);
  sweeps(results);
  plane(results);
  hand_like(results);
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
