// Lines with words over the object of a view.

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "common/colours.h"
#include "panels/view.h"

namespace chainmail {
QRectF annotationBox(const Annotation& annotation, const QFontMetricsF& font, QSizeF view) {
  QRectF box = font.boundingRect(QRectF(0, 0, view.width(), view.height()), Qt::AlignLeft, annotation.words);
  box.adjust(-annotationPadding, -annotationPadding, annotationPadding, annotationPadding);
  // Beside the line, above it, however it slants: as far along its normal as the box reaches across. And inside the
  // view.
  const QLineF line = annotation.line.length() > 0 ? annotation.line.normalVector().unitVector() : QLineF(0, 0, 0, -1);
  const QPointF normal = line.dy() > 0 ? QPointF(-line.dx(), -line.dy()) : QPointF(line.dx(), line.dy());
  const double across = (std::abs(normal.x()) * box.width() + std::abs(normal.y()) * box.height()) / 2;
  box.moveCenter(annotation.line.center() + normal * (across + annotationEndDiameter));
  box.moveLeft(std::clamp(box.left(), 0.0, std::max(0.0, view.width() - box.width())));
  box.moveTop(std::clamp(box.top(), 0.0, std::max(0.0, view.height() - box.height())));
  return box;
}

namespace {

constexpr float groundOpacity = 0.8F;

void drawAnnotation(QPainter& painter, const Annotation& annotation, QColor ground, QSizeF view) {
  painter.setPen(QPen(QColor(colours::marked), 1.5));
  for (const QPointF& end : {annotation.line.p1(), annotation.line.p2()}) {
    painter.drawEllipse(end, annotationEndDiameter / 2, annotationEndDiameter / 2);
  }
  const QRectF box = annotationBox(annotation, QFontMetricsF(painter.font()), view);
  ground.setAlphaF(groundOpacity * ground.alphaF());
  painter.fillRect(box, ground);
  painter.drawText(box.adjusted(annotationPadding, annotationPadding, -annotationPadding, -annotationPadding),
                   Qt::AlignLeft, annotation.words);
}

}  // namespace

std::vector<Annotation> View::annotations() const {
  std::vector<Annotation> all;
  for (const Overlay* overlay : overlays_) {
    const auto more = overlay->annotations(*this);
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

void View::drawAnnotations(const Easel& on) {
  const auto annotations = this->annotations();
  if (annotations.empty()) {
    return;
  }
  for (const Annotation& annotation : annotations) {
    on.own.drawStroke(on.scene, std::array{annotation.line.p1(), annotation.line.p2()}, colours::marked);
  }
  on.own.drawWords(on.scene, [&](QPainter& painter) {
    for (const Annotation& annotation : annotations) {
      drawAnnotation(painter, annotation, on.scene.background, size());
    }
  });
}

}  // namespace chainmail
