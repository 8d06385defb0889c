// What is drawn over the object, in lines.

#include "drawing/colour_map.h"
#include "drawing/drawn_indices.h"
#include "drawing/vector_painter.h"

namespace chainmail {
namespace {

constexpr std::size_t ringsDrawn = 5'000;  // more hide each other

ObjectDrawing::Scene withoutFog(ObjectDrawing::Scene scene) {
  scene.fog = {};
  return scene;
}

}  // namespace

void VectorPainter::drawSeeThrough(const Scene& /*scene*/, double opacity, const std::function<void()>& draw) {
  if (opacity > 0) {
    flush();
    painter_.setOpacity(std::min(opacity, 1.0));
    draw();
    flush();
    painter_.setOpacity(1);
  }
}

void VectorPainter::drawElements(const Scene& scene, std::span<const ElementId> elements, QColor colour, float diameter,
                                 Mark mark) {
  flush();
  for (const ElementId element : elements) {
    const QVector3D place = inSpace(element);
    add(withoutFog(scene), std::span(&place, 1), colour, diameter, mark);
  }
  flush();
}

void VectorPainter::drawSelection(const Scene& scene, QColor colour, float diameter) {
  drawElements(scene, thinned(selected_, ringsDrawn), colour, diameter,
               diameter < smallestRing ? Mark::disc : Mark::ring);
}

void VectorPainter::drawLinks(const Scene& scene, std::span<const LinkId> links, QColor colour) {
  std::vector<QVector3D> places;
  for (const LinkId link : links) {
    for (const ElementId e : frame_->mesh->links[link]) {
      places.push_back(inSpace(e));
    }
  }
  drawInSpace(scene, places, Shape::segments, colour, litWidth);
}

void VectorPainter::drawStroke(const Scene& /*scene*/, std::span<const QPointF> places, QColor colour) {
  flush();
  painter_.setPen(QPen(colour, 1));
  painter_.setBrush(Qt::NoBrush);
  painter_.drawPolyline(places.data(), int(places.size()));
}

void VectorPainter::drawInSpace(const Scene& scene, std::span<const QVector3D> places, Shape shape, QColor colour,
                                float width) {
  flush();
  const std::size_t corners = shape == Shape::segments ? 2 : 3;
  for (std::size_t i = 0; i + corners <= places.size(); i += corners) {
    add(withoutFog(scene), places.subspan(i, corners), colour, corners == 2 ? width : 0);
  }
  flush();
}

void VectorPainter::drawValued(const Scene& scene, std::span<const QVector3D> places, std::span<const float> values,
                               const ColourScale& scale, Shape shape, float width) {
  const auto in = withoutFog(scene);
  const float lift = 2 * float(frame_->mesh->mean_link_length);
  const bool lines = shape == Shape::segments;
  for (std::size_t i = 0, step = lines ? 2 : 1; i + step <= places.size(); i += step) {
    const float value = lines ? (values[i] + values[i + 1]) / 2 : values[i];
    add(in, places.subspan(i, step), colour_map::of(value, scale), width,
        shape == Shape::rings ? Mark::ring : Mark::disc, lift);
  }
}

void VectorPainter::drawWords(const Scene& /*scene*/, const std::function<void(QPainter&)>& draw) {
  flush();
  draw(painter_);
}

}  // namespace chainmail
