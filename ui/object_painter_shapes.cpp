// Shapes of others over the object, given by places in space.

#include "object_painter.h"
#include "projection.h"

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

}  // namespace chainmail
