// What is drawn over the object: marks of elements and links, and the tools' strokes.

#include <QOpenGLPaintDevice>
#include <QPainter>

#include "drawing/drawn_indices.h"
#include "drawing/object_painter.h"
#include "drawing/upload.h"

namespace chainmail {
namespace {

// More marks hide each other, and cost time.
constexpr std::size_t ringsDrawn = 50'000;

}  // namespace

void ObjectPainter::drawElements(const Scene& scene, std::span<const ElementId> elements, QColor colour, float diameter,
                                 Mark mark) {
  std::vector<float> places;
  for (const ElementId e : elements) {
    const float* at = frame_->positions.data() + std::size_t{e} * mesh_->space_dimension;
    places.insert(places.end(), at, at + mesh_->space_dimension);
  }
  drawOwn(scene, places, GL_POINTS, colour, int(mark), diameter);
}

void ObjectPainter::setSelection(const std::vector<ElementId>& elements) {
  selectedIndices_ = upload(selected_, thinned(elements, ringsDrawn));
}

void ObjectPainter::drawSelection(const Scene& scene, QColor colour, float diameter) {
  if (selectedIndices_ == 0) {
    return;
  }
  glDisable(GL_DEPTH_TEST);
  positions_.bind();
  Scene over = scene;
  over.fog = {};
  const bool small = diameter < smallestRing;
  use(over, colour, int(small ? Mark::disc : Mark::ring), mesh_->space_dimension);
  program_->setUniformValue("point_size", diameter * scene.pixelRatio);
  selected_.bind();
  glDrawElements(GL_POINTS, selectedIndices_, GL_UNSIGNED_INT, nullptr);
  vertexArray_.release();
}

void ObjectPainter::drawLinks(const Scene& scene, std::span<const LinkId> links, QColor colour) {
  std::vector<float> places;
  for (const LinkId link : links) {
    for (const ElementId e : mesh_->links[link]) {
      const float* at = frame_->positions.data() + std::size_t{e} * mesh_->space_dimension;
      places.insert(places.end(), at, at + mesh_->space_dimension);
    }
  }
  glLineWidth(litWidth * scene.pixelRatio);
  drawOwn(scene, places, GL_LINES, colour, 0, 1);
  glLineWidth(1);
}

void ObjectPainter::drawWords(const Scene& scene, const std::function<void(QPainter&)>& draw) {
  QOpenGLPaintDevice device(scene.size.toSize());
  device.setDevicePixelRatio(double(scene.pixelRatio));
  QPainter painter(&device);
  draw(painter);
}

/// Draws positions that are not the object's buffer, over everything else.
void ObjectPainter::drawOwn(const Scene& scene, std::span<const float> positions, GLenum mode, QColor colour,
                            int shading, float diameter) {
  if (positions.empty()) {
    return;
  }
  glDisable(GL_DEPTH_TEST);
  scratch_.bind();
  scratch_.allocate(positions.data(), int(positions.size_bytes()));
  Scene over = scene;
  over.fog = {};
  use(over, colour, shading, mesh_->space_dimension);
  program_->setUniformValue("point_size", diameter * scene.pixelRatio);
  glDrawArrays(mode, 0, GLsizei(positions.size() / mesh_->space_dimension));
  vertexArray_.release();
}

void ObjectPainter::drawStroke(const Scene& scene, std::span<const QPointF> places, QColor colour) {
  if (places.size() < 2) {
    return;
  }
  std::vector<float> device;
  for (const QPointF& place : places) {
    device.push_back(float(2 * place.x() * scene.pixelRatio / scene.size.width() - 1));
    device.push_back(float(1 - 2 * place.y() * scene.pixelRatio / scene.size.height()));
  }
  glDisable(GL_DEPTH_TEST);
  scratch_.bind();
  scratch_.allocate(device.data(), int(device.size() * sizeof(float)));
  use(scene, colour, 0, 2);
  program_->setUniformValue("to_view", QMatrix4x4());
  program_->setUniformValue("to_clip", QMatrix4x4());
  glLineWidth(scene.pixelRatio);
  glDrawArrays(GL_LINE_STRIP, 0, GLsizei(places.size()));
  glLineWidth(1);
  vertexArray_.release();
}

}  // namespace chainmail
