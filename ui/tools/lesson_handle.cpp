#include "tools/lesson_handle.h"

#include <algorithm>

#include "common/colours.h"

namespace chainmail {
namespace {

constexpr float singleSize = 13, edge = 4;         // pixels; the edge is the background around the mark, both sides
constexpr double smallest = 2, largest = 10;       // diameter of the mark of one of many elements, pixels
constexpr double share = 0.5, spatialShare = 0.2;  // that diameter, in link lengths

}  // namespace

void LessonHandle::draw(const Canvas& canvas) {
  const auto dragged = player_.dragged();
  if (dragged.size() == 1) {
    canvas.painter.drawElements(canvas.scene, dragged, canvas.scene.background, singleSize + edge);
    canvas.painter.drawElements(canvas.scene, dragged, colours::lit, singleSize);
  } else if (!dragged.empty()) {
    const Mesh& mesh = *canvas.frame.mesh;
    const double pixels = (mesh.space_dimension == 3 ? spatialShare : share) * mesh.mean_link_length;
    const auto diameter = float(std::clamp(pixels / canvas.unitsPerPixel, smallest, largest));
    canvas.painter.drawElements(canvas.scene, dragged, colours::lit, diameter);
  }
}

}  // namespace chainmail
