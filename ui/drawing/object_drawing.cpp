#include "drawing/object_drawing.h"

#include "common/colours.h"
#include "drawing/colour_map.h"

namespace chainmail {
namespace {

constexpr ElementId mostElementsMarked = 20'000;
constexpr double pixelsBetweenMarks = 9;
constexpr float planeFaceOpacity = 0.08F;
// Shadows on a light ground must not hide the links.
constexpr float darkest = 0.55F, darkestUnderLinks = 0.82F;

}  // namespace

bool ObjectDrawing::marksElements(const Mesh& mesh, double pixelsPerUnit) {
  return mesh.element_count() <= mostElementsMarked && mesh.mean_link_length * pixelsPerUnit >= pixelsBetweenMarks;
}

QColor ObjectDrawing::faceColour(const Mesh& mesh, const Paint& paint) {
  QColor face = ownColour(mesh, paint);
  if (!paint.look.links) {
    return colours::solid(face);
  }
  if (mesh.space_dimension == 3) {
    return colours::faint(face);
  }
  face.setAlphaF(planeFaceOpacity);
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
