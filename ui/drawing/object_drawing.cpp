#include "drawing/object_drawing.h"

namespace chainmail {
namespace {

constexpr ElementId maxElementsMarked = 20'000;
constexpr double pixelsBetweenMarks = 9;
constexpr float planeFaceOpacity = 0.12F;
// Edges on a surface are invisible below the first length and fully visible above the second (pixels).
constexpr double shortestEdge = 4, longEdge = 14;
constexpr float edgeOpacity = 0.62F;  // a contrast of 3 to the faces
// Links without a surface stay visible however short they are: many of them are next to each other.
constexpr double faintestLinks = 0.45;
// Widths of links that are coloured by values, as fractions of their length in the view, with limits in pixels.
constexpr double shareOfLength = 0.2, shareOfThick = 0.35, thinnest = 1, thinnestThick = 2, thickest = 3.5;
constexpr float linksFade = 0.75F, solidFade = 0.3F;

/// Returns 0 for edges too short to be seen, 1 for long ones.
double shareOfLongEdge(const Mesh& mesh, double pixelsPerUnit) {
  return std::clamp((mesh.mean_link_length * pixelsPerUnit - shortestEdge) / (longEdge - shortestEdge), 0.0, 1.0);
}

/// Returns the opacity of links without a surface. Those of a line stay opaque: none is next to them.
float shareOfLink(const Mesh& mesh, double pixelsPerUnit) {
  return mesh.space_dimension == 1 ? 1 : float(std::max(faintestLinks, shareOfLongEdge(mesh, pixelsPerUnit)));
}

}  // namespace

bool ObjectDrawing::marksElements(const Mesh& mesh, double pixelsPerUnit) {
  // Without links, marks are all that there is to see.
  return mesh.link_count() == 0 ||
         (mesh.element_count() <= maxElementsMarked && mesh.mean_link_length * pixelsPerUnit >= pixelsBetweenMarks);
}

QColor ObjectDrawing::faceColour(const Mesh& mesh, const Paint& paint) {
  QColor face = ownColour(mesh, paint);
  if (isSolid(mesh, paint.options)) {
    return colours::light(face);
  }
  if (!paint.options.links) {
    return colours::solid(face);
  }
  face.setAlphaF(planeFaceOpacity);
  return face;
}

QColor ObjectDrawing::ownColour(const Mesh& mesh, const Paint& paint) {
  return valuesFit(&mesh, paint) ? QColor(colour_map::neutral) : paint.colour;
}

QColor ObjectDrawing::linkColour(const Mesh& mesh, const Paint& paint, double pixelsPerUnit) {
  if (!isSolid(mesh, paint.options)) {
    QColor colour = paint.colour;
    colour.setAlphaF(shareOfLink(mesh, pixelsPerUnit));
    return colour;
  }
  QColor colour = colours::edge(ownColour(mesh, paint));
  // Next to values on the faces, short edges would darken these.
  const double least = facesByValues(&mesh, paint) ? 0 : 0.1;
  colour.setAlphaF(edgeOpacity * float(std::max(least, shareOfLongEdge(mesh, pixelsPerUnit))));
  return colour;
}

QColor ObjectDrawing::neutralColour(const Mesh& mesh, double pixelsPerUnit) {
  QColor colour = colour_map::neutral;
  colour.setAlphaF(shareOfLink(mesh, pixelsPerUnit));
  return colour;
}

float ObjectDrawing::linkWidth(const Mesh& mesh, const Paint& paint, double pixelsPerUnit) {
  const double pixels = mesh.mean_link_length * pixelsPerUnit;
  return thickensLinks(&mesh, paint) ? float(std::clamp(shareOfLength * pixels, thinnest, double(valuedWidth)))
                                     : valuedWidth;
}

float ObjectDrawing::thickWidth(const Mesh& mesh, double pixelsPerUnit) {
  return float(std::clamp(shareOfThick * mesh.mean_link_length * pixelsPerUnit, thinnestThick, thickest));
}

bool ObjectDrawing::distinguishesEdges(const Mesh& mesh, double pixelsPerUnit) {
  return mesh.mean_link_length * pixelsPerUnit >= shortestEdge;
}

Lighting ObjectDrawing::lighting(const Mesh& mesh, const Paint& paint) {
  return facesByValues(&mesh, paint) ? Lighting::ofValues() : Lighting::onGround();
}

float ObjectDrawing::fade(const Mesh& mesh, const Paint& paint) {
  return !isSolid(mesh, paint.options) ? linksFade : facesByValues(&mesh, paint) ? 0 : solidFade;
}

float ObjectDrawing::frontSign(const Mesh& mesh) {
  float sign = 0;
  for (const auto& corners : mesh.triangles) {
    const double* at = mesh.rest.data();
    const auto along = [&](std::size_t to, int k) {
      return at[2 * std::size_t{corners[to]} + k] - at[2 * std::size_t{corners[0]} + k];
    };
    const double area = along(1, 0) * along(2, 1) - along(1, 1) * along(2, 0);
    if (area * double(sign) < 0) {
      return 0;
    }
    sign = area > 0 ? 1.0F : area < 0 ? -1.0F : sign;
  }
  return sign;
}

}  // namespace chainmail
