#pragma once

#include "bench/contest.h"
#include "bench/scenes.h"

namespace chainmail::bench {

/// An algorithm as it is measured, by its name on the command line.
inline const std::string natural_queue = "natural-queue";
inline const std::string natural_queue_without_replay = "natural-queue-without-replay";
inline const std::string exact = "exact";
inline const std::string memory_floor = "floor";

/// A solver in float, as the window runs it, in this drag.
Contestant dragged(const MeshPointer& mesh, const std::string& algorithm, Drag drag);

/// A contest over a mesh; its passes are so many that a repetition takes some hundredths of a second and more.
Contest contest(Drag drag, const std::string& mesh_name, const MeshPointer& mesh,
                const std::vector<std::string>& algorithms);

}  // namespace chainmail::bench
