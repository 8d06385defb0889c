#include "drawing/prepared_levels.h"

#include <mutex>
#include <utility>

#include "drawing/coarse_level.h"
#include "drawing/mesh_levels.h"

namespace chainmail {
namespace {

// The levels of smaller meshes are computed when they are needed, in some milliseconds.
constexpr ElementId fewestElements = 100'000;

std::mutex mutex;
std::vector<MeshLevelPointer> prepared;  // guarded by the mutex

bool isSmall(const MeshLevel& level) { return level.elements.size() < fewestElements; }

}  // namespace

void prepareLevels(const MeshPointer& mesh, const Progress& progress) {
  std::vector<MeshLevelPointer> levels;
  if (mesh->element_count() >= fewestElements) {
    progress.report(0);
    levels.push_back(wholeLevel(mesh));
    // Which one is drawn first depends on the size of the view. The finest are drawn only after a zoom.
    for (unsigned step = 2; !isSmall(*levels.back()); step = MeshLevels::after(step, *mesh)) {
      progress.report(0.5);
      if (!mesh->lattice) {
        levels.push_back(coarser(*levels.back()));
      } else if (mesh->element_count() / (step * step) < 10 * fewestElements) {
        levels.push_back(coarseLattice(mesh, step));
      }
    }
  }
  const std::lock_guard lock(mutex);
  prepared = std::move(levels);
}

std::vector<MeshLevelPointer> takePreparedLevels(const MeshPointer& mesh) {
  const std::lock_guard lock(mutex);
  auto levels = std::exchange(prepared, {});
  return !levels.empty() && levels.front()->mesh == mesh ? levels : std::vector<MeshLevelPointer>();
}

}  // namespace chainmail
