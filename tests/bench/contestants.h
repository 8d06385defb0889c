#pragma once

#include "bench/contest.h"
#include "bench/scenes.h"

namespace chainmail::bench {

/// The algorithms as they are measured. Those not named here go by their name on the command line.
namespace names {
inline const std::string natural_queue = "natural-queue";
/// Every pass worked out anew, whatever the pass before did.
inline const std::string without_replay = "natural-queue-without-replay";
inline const std::string exact = "exact";
/// The first pass of a drag, which has to find the regions about the hand.
inline const std::string exact_anew = "exact-first-pass";
/// Stream the bytes that a later whole-body pass of the algorithm touches, each once.
inline const std::string natural_queue_bytes = "natural-queue-bytes-once";
inline const std::string exact_bytes = "exact-bytes-once";
/// Natural Queue literally as the thesis describes it: tests/reference.
inline const std::string of_2004 = "natural-queue-2004";
/// Natural Queue on arrays: textbook.h.
inline const std::string textbook = "natural-queue-textbook";
}  // namespace names

/// A mesh under its name.
struct Scene {
  explicit Scene(const std::string& of) : name(of), mesh(make_mesh(of)) {}
  std::string name;
  MeshPointer mesh;
};

/// A solver in float, as the window runs it, in this drag, past its first passes. That a whole-body drag moves fewer
/// than 95 % of the elements is an error.
Contestant dragged(const Scene& scene, const std::string& algorithm, Drag drag);

/// The literal version (thesis 4.2: lists, and a search through a list wherever something is looked up).
Contestant dragged_as_2004(const Scene& scene);

/// The textbook version, in float. That it does not answer a drag as the solver does, bit for bit, is an error.
Contestant dragged_by_textbook(const Scene& scene);

/// The time that memory alone takes to touch the bytes of a pass once; `algorithm` is one of names::…_bytes. Each pass
/// streams another copy, and all copies together are as large as what a solver holds: the caches hold of it what they
/// would hold after a pass.
Contestant streamed(const Scene& scene, const std::string& algorithm);

/// What the passes of some hand-like drags took (report/run/scripted_drags.h), all with the default softness.
struct HandLike {
  double ns_per_moved = 0;  // over all passes
  double median_ms = 0;     // of a pass
  double worst_ms = 0;
};
HandLike hand_like_drags(const Scene& scene, const std::string& algorithm);

}  // namespace chainmail::bench
