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

/// How often an object lies behind itself, at rest.
double layers(const Mesh& mesh) {
  const bool spatial = mesh.space_dimension == 3;
  return mesh.object_dimension == 3 ? std::cbrt(mesh.element_count()) : spatial ? 2 : 1;
}

}  // namespace

/// About how many links and faces would be seen, from what has room in the view.
double ObjectPainter::shapesInView(const Scene& scene, double pixels) const {
  const double room = scene.size.width() * scene.size.height() / (scene.pixelRatio * scene.pixelRatio);
  const double share = std::min(1.0, room / (pixels * pixels) * layers(*mesh_) / mesh_->element_count());
  return share * elementsAt(*mesh_, step_) * shapesPerElement(*mesh_, step_);
}

void ObjectPainter::chooseStep(const Scene& scene, double pixelsPerUnit) {
  step_ = 1;
  const double pixels = mesh_->mean_link_length * pixelsPerUnit;
  if (mesh_->links.size() + mesh_->triangles.size() <= shapesDrawn || !(pixels > 0)) {
    return;
  }
  while (step_ < coarsest && (pixels * step_ < pixelsPerLink || shapesInView(scene, pixels) > shapesDrawn)) {
    step_ *= 2;
  }
}

std::vector<std::uint32_t> ObjectPainter::visibleCells(const Scene& scene) {
  std::vector<std::uint32_t> cells(level_->cellCount());
  std::iota(cells.begin(), cells.end(), 0U);
  if (level_->links.size() + level_->faces.size() <= shapesDrawn) {
    return cells;
  }
  boxes_.follow(level_, *frame_);
  const auto bounds = reachedBounds(boxes_, Projection(*mesh_, scene.toView, scene.toClip, scene.size));
  const QRectF view(QPointF(), scene.size);
  std::erase_if(cells, [&](std::uint32_t cell) { return !bounds[cell].meets(view); });
  return cells;
}

/// Costs what is drawn, not what there is, and only when another part is seen or a link was cut.
void ObjectPainter::makeLists(const Scene& scene) {
  if (level_ == nullptr || level_->step != step_) {
    level_ = levels_->at(mesh_, step_);
    listsOutdated_ = true;
  }
  auto cells = visibleCells(scene);
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
