#include "panels/overlay.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "common/colours.h"

namespace chainmail {
namespace {

constexpr float boxOpacity = 0.8F;

/// Returns the box behind the text: next to the line and inside the view.
QRectF annotationBox(const Annotation& annotation, const QFontMetricsF& font, QSizeF view) {
  QRectF box = font.boundingRect(QRectF(0, 0, view.width(), view.height()), Qt::AlignLeft, annotation.words);
  box.adjust(-annotationPadding, -annotationPadding, annotationPadding, annotationPadding);
  // Moves the box along the upward normal of the line by half its extent in that direction, so that it does not cover
  // the line.
  const QLineF line = annotation.line.length() > 0 ? annotation.line.normalVector().unitVector() : QLineF(0, 0, 0, -1);
  const QPointF normal = line.dy() > 0 ? QPointF(-line.dx(), -line.dy()) : QPointF(line.dx(), line.dy());
  const double across = (std::abs(normal.x()) * box.width() + std::abs(normal.y()) * box.height()) / 2;
  box.moveCenter(annotation.line.center() + normal * (across + annotationEndDiameter));
  box.moveLeft(std::clamp(box.left(), 0.0, std::max(0.0, view.width() - box.width())));
  box.moveTop(std::clamp(box.top(), 0.0, std::max(0.0, view.height() - box.height())));
  return box;
}

}  // namespace

void drawAnnotation(QPainter& painter, const Annotation& annotation, QColor ground, QSizeF view) {
  painter.setPen(QPen(QColor(colours::marked), 1.5));
  for (const QPointF& end : {annotation.line.p1(), annotation.line.p2()}) {
    painter.drawEllipse(end, annotationEndDiameter / 2, annotationEndDiameter / 2);
  }
  const QRectF box = annotationBox(annotation, QFontMetricsF(painter.font()), view);
  ground.setAlphaF(boxOpacity * ground.alphaF());
  painter.fillRect(box, ground);
  painter.drawText(box.adjusted(annotationPadding, annotationPadding, -annotationPadding, -annotationPadding),
                   Qt::AlignLeft, annotation.words);
}

}  // namespace chainmail
