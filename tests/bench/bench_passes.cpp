// Prints the time of a pass for all meshes and drags: bench_passes [FILTER…]. A filter is a part of
// DRAG/MESH/ALGORITHM, such as whole_body/grid1024, local or /exact. A row is measured if all filters match.
// natural-queue-bytes-once and exact-bytes-once are the times that memory alone needs for a later whole-body pass.

#include <algorithm>
#include <optional>

#include "bench/contestants.h"

using namespace chainmail::bench;

int main(int argc, char** argv) {
  const std::vector<std::string> filters(argv + 1, argv + argc);
  const auto unwanted = [&](const std::string& row) {
    return std::any_of(filters.begin(), filters.end(), [&](auto& one) { return row.find(one) == row.npos; });
  };
  for (const char* mesh : {"grid64", "grid256", "grid1024", "grid2048", "cloth512", "block100", "tetra60",
                           "jittered_grid1024", "jittered_cloth512", "jittered_tetra60"}) {
    std::optional<Scene> scene;
    for (const Drag drag : {Drag::whole_body, Drag::local, Drag::whole_body_mixed}) {
      std::vector<Contestant> contest;
      for (const std::string& algorithm :
           {names::natural_queue, names::without_replay, names::exact, names::exact_anew, std::string("generalized")}) {
        if (!unwanted(name(drag) + "/" + mesh + "/" + algorithm)) {
          scene = scene ? scene : Scene(mesh);
          contest.push_back(dragged(*scene, algorithm, drag));
        }
      }
      for (const std::string& bytes : {names::natural_queue_bytes, names::exact_bytes}) {
        if (drag == Drag::whole_body && !unwanted(name(drag) + "/" + mesh + "/" + bytes)) {
          scene = scene ? scene : Scene(mesh);
          contest.push_back(streamed(*scene, bytes));
        }
      }
      if (!contest.empty()) {
        run(contest);
      }
    }
  }
}
