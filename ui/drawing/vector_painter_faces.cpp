// The object's faces in areas: shaded, pictured, cut by a section.

#include <cmath>

#include "common/colours.h"
#include "drawing/colour_map.h"
#include "drawing/vector_painter.h"

namespace chainmail {
namespace {

constexpr float seam = 0.4F;  // pixels: faces meet without a gap of the ground's colour

/// The mean of a few texels of a triangle, at rest.
QColor texelsOf(const Texture& texture, const std::array<Point, 3>& corners) {
  std::array<int, 4> sum{};
  int count = 0;
  for (const auto& [a, b, c] : {std::array{2, 2, 2}, std::array{4, 1, 1}, std::array{1, 4, 1}, std::array{1, 1, 4}}) {
    const Point at = (a * corners[0] + b * corners[1] + c * corners[2]) / 6;
    std::size_t texel = 0;
    for (int k = 2; k >= 0; --k) {
      const double length = texture.box[1][k] - texture.box[0][k];
      const double share = length > 0 ? (at[k] - texture.box[0][k]) / length : 0;
      const double last = texture.size[k] - 1.0;
      texel = texel * texture.size[k] + std::size_t(std::clamp(std::floor(share * texture.size[k]), 0.0, last));
    }
    for (int channel = 0; channel < 4; ++channel) {
      const bool grey = texture.channels == 1;
      sum[channel] += grey && channel == 3 ? 255 : texture.texels[texel * texture.channels + (grey ? 0 : channel)];
    }
    ++count;
  }
  return {sum[0] / count, sum[1] / count, sum[2] / count, sum[3] / count};
}

}  // namespace

QColor VectorPainter::lit(const Scene& scene, std::span<const QVector3D> places, const QColor& colour,
                          const Look& look) {
  const QVector3D normal = QVector3D::normal(places[0], places[1], places[2]);
  const float share = std::lerp(darkestFace(look), 1.0F, std::abs(scene.toView.mapVector(normal).z()));
  return QColor::fromRgbF(share * colour.redF(), share * colour.greenF(), share * colour.blueF(), colour.alphaF());
}

std::array<float, 2> VectorPainter::shown(ElementId from, ElementId to, const Look& look) const {
  const double first = beforeSection(from, look), last = beforeSection(to, look);
  const float meets = float(first / (first - last));
  return {first > 0 ? (last > 0 ? 1 : meets) : 0, last > 0 ? (first > 0 ? 0 : meets) : 1};
}

std::vector<QVector3D> VectorPainter::shown(std::span<const ElementId> corners, const Look& look) const {
  std::vector<QVector3D> places;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const ElementId a = corners[i], b = corners[(i + 1) % corners.size()];
    const double before = beforeSection(a, look), next = beforeSection(b, look);
    if (!(before > 0)) {
      places.push_back(inSpace(a));
    }
    if ((before > 0) != (next > 0)) {
      places.push_back(inSpace(a) + float(before / (before - next)) * (inSpace(b) - inSpace(a)));
    }
  }
  return places;
}

double VectorPainter::beforeSection(ElementId element, const Look& look) const {
  return look.section ? look.section->before(frame_->mesh->rest_position(element)) : 0;
}

void VectorPainter::addFaces(const Scene& scene, const Paint& paint) {
  const Mesh& mesh = *frame_->mesh;
  const QColor colour = faceColour(mesh, paint);
  const bool pictured = showsPicture(mesh), valued = facesByValues(&mesh, paint);
  const bool spatial = mesh.space_dimension == 3;
  const auto corners = parts_.faces();
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    const auto elements = std::span(corners).subspan(i, 3);
    const auto places = shown(elements, paint.look);
    for (std::size_t j = 2; j < places.size(); ++j) {
      const std::array part{places[0], places[j - 1], places[j]};
      QColor face = colour;
      if (pictured) {
        face = texelsOf(*mesh.texture, {mesh.rest_position(elements[0]), mesh.rest_position(elements[1]),
                                        mesh.rest_position(elements[2])});
      } else if (valued) {
        const auto& values = paint.values->values;
        face = colour_map::of((values[elements[0]] + values[elements[1]] + values[elements[2]]) / 3, paint.scale);
      } else if (spatial) {
        face = lit(scene, part, colour, paint.look);
      }
      add(scene, part, face, spatial || pictured || valued ? seam : 0);
    }
  }
}

void VectorPainter::addCap(const Scene& scene, const Paint& paint) {
  const Section* section = parts_.section();
  if (section == nullptr) {
    return;
  }
  const Mesh& mesh = *frame_->mesh;
  const auto places = placesOf(*section, *frame_);
  const auto corners = section->triangles(parts_.surface());
  const auto rest = [&](std::uint32_t corner) -> Point {
    const SectionPoint& point = section->points()[corner];
    const Point from = mesh.rest_position(point.from);
    return from + double(point.share) * (mesh.rest_position(point.to) - from);
  };
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    const std::array part{places[corners[i]], places[corners[i + 1]], places[corners[i + 2]]};
    const QColor face = showsSlices(mesh)
                            ? texelsOf(*mesh.texture, {rest(corners[i]), rest(corners[i + 1]), rest(corners[i + 2])})
                            : lit(scene, part, sectionColour(mesh, paint), paint.look);
    add(scene, part, face, seam);
  }
}

}  // namespace chainmail
