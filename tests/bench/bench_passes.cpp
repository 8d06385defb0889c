// The time of a pass, over all meshes and drags: bench_passes [FILTER…], where a filter is a part of
// DRAG/MESH/ALGORITHM, as whole_body/grid1024 or local or /exact; a row is measured where all filters fit.

#include <algorithm>
#include <cstdio>

#include "bench/contestants.h"

using namespace chainmail;
using namespace chainmail::bench;

int main(int argc, char** argv) {
  const std::vector<std::string> filters(argv + 1, argv + argc);
  const auto wanted = [&](const std::string& row) {
    return std::all_of(filters.begin(), filters.end(), [&](auto& one) { return row.find(one) != row.npos; });
  };
  std::printf("%-18s %-18s %-24s %9s %11s %13s %11s\n", "drag", "mesh", "algorithm", "elements", "moved", "a pass",
              "a moved one");
  for (const char* mesh_name : {"grid64", "grid256", "grid1024", "grid2048", "cloth512", "block100", "tetra60",
                                "jittered_grid1024", "jittered_cloth512", "jittered_tetra60"}) {
    MeshPointer mesh;
    for (const Drag drag : {Drag::whole_body, Drag::local, Drag::whole_body_mixed}) {
      std::vector<std::string> algorithms{natural_queue, natural_queue_without_replay, exact};
      std::erase_if(algorithms, [&](auto& one) { return !wanted(name(drag) + "/" + mesh_name + "/" + one); });
      if (!algorithms.empty()) {
        mesh = mesh ? mesh : make_mesh(mesh_name);
        run(contest(drag, mesh_name, mesh, algorithms));
      }
    }
  }
}
