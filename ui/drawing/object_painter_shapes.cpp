// Shapes of others over the object, given by places in space.

#include "drawing/object_painter.h"
#include "drawing/projection.h"

namespace chainmail {

void ObjectPainter::drawInSpace(const Scene& scene, std::span<const QVector3D> places, Shape shape, QColor colour,
                                float width) {
  if (places.empty()) {
    return;
  }
  glDisable(GL_DEPTH_TEST);
  scratch_.bind();
  scratch_.allocate(places.data(), int(places.size_bytes()));
  Scene over = scene;
  over.fog = {};
  use(over, colour, 0, 3);
  program_->setUniformValue("to_view", scene.toView);
  const bool lines = shape == Shape::segments;
  if (lines) {
    glLineWidth(width * scene.pixelRatio);
    glEnable(GL_LINE_SMOOTH);
  }
  glDrawArrays(lines ? GL_LINES : GL_TRIANGLES, 0, GLsizei(places.size()));
  glDisable(GL_LINE_SMOOTH);
  glLineWidth(1);
  vertexArray_.release();
}

namespace {

// Of an object's depth: what is drawn over its surface lies this much nearer, so that faces about it do not cut it.
constexpr float lift = 0.04F;

/// To the same places of the view, a little nearer to the eye.
QMatrix4x4 lifted(const ObjectPainter::Scene& scene) {
  if (scene.fog.y() <= scene.fog.x()) {
    return scene.toClip;
  }
  const float middle = (scene.fog.x() + scene.fog.y()) / 2, nearer = middle - lift * (scene.fog.y() - scene.fog.x());
  QMatrix4x4 shift;
  shift(2, 3) = scene.toClip.map(QVector3D(0, 0, -nearer)).z() - scene.toClip.map(QVector3D(0, 0, -middle)).z();
  return shift * scene.toClip;
}

}  // namespace

void ObjectPainter::drawValued(const Scene& scene, std::span<const QVector3D> places, std::span<const float> values,
                               const ColourScale& scale, Shape shape, float width) {
  if (places.empty()) {
    return;
  }
  const bool lines = shape == Shape::segments;
  if (mesh_->space_dimension == 3) {
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
  }
  scratch_.bind();
  scratch_.allocate(int(places.size_bytes() + values.size_bytes()));
  scratch_.write(0, places.data(), int(places.size_bytes()));
  scratch_.write(int(places.size_bytes()), values.data(), int(values.size_bytes()));
  Scene over = scene;
  over.fog = {};  // a colour is a number
  use(over, {}, lines ? 0 : int(shape == Shape::discs ? Mark::disc : Mark::ring), 3, 1);
  program_->setUniformValue("to_view", scene.toView);
  program_->setUniformValue("to_clip", lifted(scene));
  useMap(scale);
  program_->enableAttributeArray(1);
  program_->setAttributeBuffer(1, GL_FLOAT, int(places.size_bytes()), 1);
  program_->setUniformValue("point_size", width * scene.pixelRatio);
  glLineWidth(lines ? width * scene.pixelRatio : 1);
  glDrawArrays(lines ? GL_LINES : GL_POINTS, 0, GLsizei(places.size()));
  glLineWidth(1);
  glDisable(GL_DEPTH_TEST);
  vertexArray_.release();
}

}  // namespace chainmail
