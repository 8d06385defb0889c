// How finely an object is drawn, and which parts of it.

#include <algorithm>
#include <cmath>
#include <numeric>

#include "object_painter.h"
#include "picking.h"
#include "upload.h"

namespace chainmail {
namespace {

// Above this many links and faces an object is drawn more coarsely where its links fall below this many pixels or too
// many are in the view, and cell by cell.
constexpr std::size_t shapesDrawn = 60'000;
constexpr double pixelsPerLink = 3;
constexpr unsigned coarsest = 64;

/// About how many elements every step-th row has, or a level that is as coarse as that.
double elementsAt(const Mesh& mesh, unsigned step) {
  if (!mesh.lattice) {
    return mesh.element_count() / std::pow(step, mesh.object_dimension);
  }
  double count = 1;
  for (const double size : mesh.lattice->size) {
    count *= step == 1 || size == 1 ? size : std::floor((size - 2) / step) + 2;
  }
  return count;
}

/// About how many links and faces there are at a step for each element.
double shapesPerElement(const Mesh& mesh, unsigned step) {
  const double faces = double(mesh.triangles.size()) / mesh.element_count();
  if (step == 1 || !mesh.lattice) {
    return faces + double(mesh.link_count()) / mesh.element_count();
  }
  const auto& size = mesh.lattice->size;
  return faces + double(std::count_if(size.begin(), size.end(), [](auto one) { return one > 1; }));
}

}  // namespace

/// Which share of the elements may be seen.
double ObjectPainter::shareInView(const Scene& scene) {
  const auto whole = levels_->at(mesh_, 1);
  const auto seen = visibleCells(scene, whole, wholeBoxes_);
  return double(seen.size()) / double(whole->cellCount());
}

/// As finely as its links can be told apart; more coarsely where too many would be seen at once, as in a volume.
void ObjectPainter::chooseStep(const Scene& scene, double pixelsPerUnit) {
  step_ = 1;
  const double pixels = mesh_->mean_link_length * pixelsPerUnit;
  if (mesh_->links.size() + mesh_->triangles.size() <= shapesDrawn || !(pixels > 0)) {
    return;
  }
  while (step_ < coarsest && pixels * step_ < pixelsPerLink) {
    step_ = MeshLevels::after(step_, *mesh_);
  }
  const auto shapes = [&] { return elementsAt(*mesh_, step_) * shapesPerElement(*mesh_, step_); };
  if (shapes() <= shapesDrawn) {
    return;
  }
  const double share = shareInView(scene);
  while (step_ < coarsest && share * shapes() > shapesDrawn) {
    step_ = MeshLevels::after(step_, *mesh_);
  }
}

std::vector<std::uint32_t> ObjectPainter::visibleCells(const Scene& scene, const MeshLevelPointer& level,
                                                       CellBoxes& boxes) const {
  if (level->links.size() + level->faces.size() <= shapesDrawn) {
    std::vector<std::uint32_t> all(level->cellCount());
    std::iota(all.begin(), all.end(), 0U);
    return all;
  }
  boxes.follow(level, *frame_);
  return cellsSeen(boxes, Projection(*mesh_, scene.toView, scene.toClip, scene.size));
}

/// Costs what is drawn, not what there is, and only when another part is seen or a link was cut.
void ObjectPainter::makeLists(const Scene& scene) {
  if (level_ == nullptr || level_->step != step_) {
    level_ = levels_->at(mesh_, step_);
    listsOutdated_ = true;
  }
  auto cells = visibleCells(scene, level_, boxes_);
  if (!listsOutdated_ && cells == cells_) {
    return;
  }
  listsOutdated_ = false;
  cells_ = std::move(cells);
  auto drawn = drawnLinks(*level_, *cuts_, cells_);
  drawnLinks_ = std::move(drawn.numbers);
  upload(links_, drawn.ends);
  faceIndices_ = upload(faces_, drawnFaces(*level_, *cuts_, cells_));
  valuesNumber_ = 0;
}

}  // namespace chainmail
