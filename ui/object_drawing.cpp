#include "object_drawing.h"

#include "colour_map.h"
#include "colours.h"

namespace chainmail {
namespace {

constexpr ElementId elementsMarked = 20'000;
constexpr double pixelsBetweenMarks = 9;
constexpr float planeFace = 0.08F;  // opacity
// On a light ground shadows must not drown the links.
constexpr float darkestOnDark = 0.55F, darkestOnLight = 0.82F;

}  // namespace

bool ObjectDrawing::marksElements(const Mesh& mesh, double pixelsPerUnit) {
  return mesh.element_count() <= elementsMarked && mesh.mean_link_length * pixelsPerUnit >= pixelsBetweenMarks;
}

QColor ObjectDrawing::faceColour(const Mesh& mesh, const Paint& paint) {
  QColor face = valuesFit(&mesh, paint) ? QColor(colour_map::neutral) : paint.colour;
  if (mesh.space_dimension == 3 || !paint.look.links) {
    return colours::faint(face);
  }
  face.setAlphaF(planeFace);
  return face;
}

float ObjectDrawing::darkestFace() {
  return colours::ground() == colours::Ground::dark ? darkestOnDark : darkestOnLight;
}

}  // namespace chainmail
