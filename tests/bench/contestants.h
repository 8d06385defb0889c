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
/// Streams the bytes that a whole-body pass must touch at least once: no algorithm is faster.
inline const std::string memory_floor = "floor";
/// Natural Queue as in 2004: tests/reference.
inline const std::string of_2004 = "natural-queue-2004";
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

/// The time that memory alone takes for PassBytes. Each pass streams another copy, and all copies together are as large
/// as what a solver holds: the caches hold of it what they would hold after a pass.
Contestant streamed(const Scene& scene);

}  // namespace chainmail::bench
