#include "drawing/object_drawing.h"

#include "common/colours.h"
#include "drawing/colour_map.h"

namespace chainmail {
namespace {

constexpr ElementId elementsMarked = 20'000;
constexpr double pixelsBetweenMarks = 9;
constexpr float planeFace = 0.08F;  // opacity
// On a light ground shadows must not drown the links.
constexpr float darkest = 0.55F, darkestUnderLinks = 0.82F;

}  // namespace

bool ObjectDrawing::marksElements(const Mesh& mesh, double pixelsPerUnit) {
  return mesh.element_count() <= elementsMarked && mesh.mean_link_length * pixelsPerUnit >= pixelsBetweenMarks;
}

QColor ObjectDrawing::faceColour(const Mesh& mesh, const Paint& paint) {
  QColor face = ownColour(mesh, paint);
  if (!paint.look.links) {
    return colours::solid(face);
  }
  if (mesh.space_dimension == 3) {
    return colours::faint(face);
  }
  face.setAlphaF(planeFace);
  return face;
}

QColor ObjectDrawing::sectionColour(const Mesh& mesh, const Paint& paint) {
  return colours::bright(ownColour(mesh, paint));
}

QColor ObjectDrawing::ownColour(const Mesh& mesh, const Paint& paint) {
  return valuesFit(&mesh, paint) ? QColor(colour_map::neutral) : paint.colour;
}

float ObjectDrawing::darkestFace(const Look& look) {
  return colours::ground() == colours::Ground::dark || !look.links ? darkest : darkestUnderLinks;
}

}  // namespace chainmail
