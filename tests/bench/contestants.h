#pragma once

#include "bench/contest.h"
#include "bench/scenes.h"

namespace chainmail::bench {

/// Names of the measured variants. All other algorithms have their names on the command line.
namespace names {
inline const std::string natural_queue = "natural-queue";
/// Computes every pass anew, without a replay of the previous pass.
inline const std::string without_replay = "natural-queue-without-replay";
inline const std::string exact = "exact";
/// The first pass of a drag, which has to find the regions about the handle.
inline const std::string exact_anew = "exact-first-pass";
/// The same two on two threads.
inline const std::string exact_threads = "exact-2-threads";
inline const std::string exact_anew_threads = "exact-first-pass-2-threads";
/// Touches all bytes that a later whole-body pass of the algorithm touches, each once.
inline const std::string natural_queue_bytes = "natural-queue-bytes-once";
inline const std::string exact_bytes = "exact-bytes-once";
/// Natural Queue exactly as the thesis describes it (tests/reference).
inline const std::string of_2004 = "natural-queue-2004";
/// Natural Queue on arrays (textbook.h).
inline const std::string textbook = "natural-queue-textbook";
}  // namespace names

/// A mesh and its name.
struct Scene {
  explicit Scene(const std::string& of) : name(of), mesh(make_mesh(of)) {}
  std::string name;
  MeshPointer mesh;
};

/// Returns a solver in float, as the window runs it, that has already made its first passes of this drag. A pass throws
/// if a whole-body drag moves fewer than 95 % of the elements.
Contestant dragged(const Scene& scene, const std::string& algorithm, Drag drag);

/// Returns the version of the thesis (4.2: all data is in lists, which are searched from the front).
Contestant dragged_as_2004(const Scene& scene);

/// Returns the textbook version, in float. Throws if its positions after a drag differ from the solver's in any bit.
Contestant dragged_by_textbook(const Scene& scene);

/// Returns a contestant that only touches the bytes of a pass once; `algorithm` is one of names::…_bytes. Each pass
/// streams another copy. Together the copies are as large as the data of a solver, so that the caches contain the same
/// share of them as after a pass.
Contestant streamed(const Scene& scene, const std::string& algorithm);

/// Returns the median time of a visit in sweeps (scheme `mean`, isotropic energy) after a whole-body drag with default
/// softness: each visit moves its element or finds it in its place (ns).
double sweep_nanoseconds(const Scene& scene);

/// Times of the passes of some hand-like drags (report/run/scripted_drags.h), with the default softness.
struct HandLike {
  double ns_per_moved = 0;  // mean over all passes
  double median_ms = 0;     // per pass
  double worst_ms = 0;
};
HandLike hand_like_drags(const Scene& scene, const std::string& algorithm);

}  // namespace chainmail::bench
