#include "drawing/prepared_levels.h"

#include <mutex>
#include <utility>

#include "drawing/coarse_level.h"
#include "drawing/mesh_levels.h"

namespace chainmail {
namespace {

// The levels of smaller meshes are computed when they are needed, in some milliseconds.
constexpr ElementId minElements = 100'000;

std::mutex mutex;
std::vector<MeshLevelPointer> prepared;  // guarded by the mutex

}  // namespace

void prepareLevels(const MeshPointer& mesh, const Progress& progress) {
  if (mesh->element_count() < minElements) {
    return;
  }
  progress.report(0);
  std::vector<MeshLevelPointer> levels{wholeLevel(mesh)};
  // Which one is drawn first depends on the size of the view. The finest are drawn only after a zoom.
  for (unsigned step = 2; step <= MeshLevels::coarsestStep && levels.back()->elements.size() >= minElements;
       step = MeshLevels::after(step, *mesh)) {
    progress.report(double(step) / MeshLevels::coarsestStep);
    if (!mesh->lattice) {
      levels.push_back(coarser(*levels.back()));
    } else if (MeshLevels::elementsAt(*mesh, step) < 10 * minElements) {
      levels.push_back(coarseLattice(mesh, step));
    }
  }
  progress.report(1);  // nothing is kept of a job that was cancelled
  const std::lock_guard lock(mutex);
  prepared = std::move(levels);
}

std::vector<MeshLevelPointer> takePreparedLevels(const MeshPointer& mesh) {
  const std::lock_guard lock(mutex);
  const bool isOfMesh = !prepared.empty() && prepared.front()->mesh == mesh;
  return isOfMesh ? std::exchange(prepared, {}) : std::vector<MeshLevelPointer>();
}

}  // namespace chainmail
