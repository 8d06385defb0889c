// Pictures of a view, of as many pixels as are asked for, or of lines.

#include <QImage>
#include <QOpenGLContext>
#include <QOpenGLFramebufferObject>
#include <QPainter>

#include "drawing/vector_painter.h"
#include "mesh/error.h"
#include "panels/view.h"

namespace chainmail {

QImage View::picture(double pixelRatio, bool transparent) {
  const QSize pixels = (QSizeF(size()) * pixelRatio).toSize();
  makeCurrent();
  GLint most = 0;
  context()->functions()->glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &most);
  if (std::max(pixels.width(), pixels.height()) > most) {
    doneCurrent();
    throw Error("picture",
                QStringLiteral("%1 × %2 pixels are more than the %3 that can be drawn here")
                    .arg(pixels.width())
                    .arg(pixels.height())
                    .arg(most)
                    .toStdString(),
                "choose a smaller scale");
  }
  QImage image;
  {
    QOpenGLFramebufferObject canvas(pixels, QOpenGLFramebufferObject::CombinedDepthStencil);
    canvas.bind();
    context()->functions()->glViewport(0, 0, pixels.width(), pixels.height());
    paint(pixelRatio, transparent ? QColor(0, 0, 0, 0) : QColor(colours::background));
    image = canvas.toImage();
  }
  doneCurrent();
  image.setDevicePixelRatio(pixelRatio);
  return image;
}

void View::drawIn(QPainter& painter, const QColor& ground) {
  painter.fillRect(QRectF(rect()), ground);
  const Frame* frame = document_.frame(panel_);
  if (frame == nullptr) {
    return;
  }
  VectorPainter drawing(painter, levels_);
  drawing.setSelection(document_.selection().elements);
  Easel easel{drawing, [&drawing]() -> ObjectDrawing& { return drawing; }, scene(1)};
  easel.scene.background = ground;
  draw(easel, *frame);
}

}  // namespace chainmail
