#include "tool_icons.h"

#include <QPainter>
#include <QPalette>
#include <functional>

#include "colours.h"

namespace chainmail::tool_icons {
namespace {

constexpr int side = 16;  // of the icon, in the units that the pictures below are drawn in

QIcon drawn(const QPalette& palette, const std::function<void(QPainter&)>& draw) {
  QIcon icon;
  for (const int scale : {1, 2, 3}) {
    QPixmap picture(side * scale, side * scale);
    picture.fill(Qt::transparent);
    picture.setDevicePixelRatio(scale);
    QPainter painter(&picture);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(palette.color(QPalette::ButtonText), 1.4, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    draw(painter);
    painter.end();
    icon.addPixmap(picture);
  }
  return icon;
}

}  // namespace

/// Four arrows from an element.
QIcon drag(const QPalette& palette) {
  return drawn(palette, [&](QPainter& painter) {
    painter.translate(8, 8);
    for (int i = 0; i < 4; ++i) {
      painter.drawLine(QPointF(0, -3.5), QPointF(0, -7));
      painter.drawPolyline(QPolygonF{{-1.8, -5.2}, {0, -7}, {1.8, -5.2}});
      painter.rotate(90);
    }
    painter.setBrush(palette.color(QPalette::ButtonText));
    painter.drawEllipse(QPointF(0, 0), 1.5, 1.5);
  });
}

/// Scissors.
QIcon cut(const QPalette& palette) {
  return drawn(palette, [](QPainter& painter) {
    painter.drawEllipse(QPointF(3.6, 12.2), 2.1, 2.1);
    painter.drawEllipse(QPointF(12.4, 12.2), 2.1, 2.1);
    painter.drawLine(QPointF(4.8, 10.4), QPointF(11.4, 1.2));
    painter.drawLine(QPointF(11.2, 10.4), QPointF(4.6, 1.2));
  });
}

/// The mark of a pinned element, on its needle.
QIcon pin(const QPalette& palette) {
  return drawn(palette, [](QPainter& painter) {
    painter.drawLine(QPointF(8, 9), QPointF(8, 15));
    painter.setPen(Qt::NoPen);
    painter.setBrush(colours::pinned);
    painter.drawPolygon(QPolygonF{{8, 0.8}, {13, 5.8}, {8, 10.8}, {3, 5.8}});
  });
}

/// A dashed rectangle with a ring, the mark of a selected element.
QIcon select(const QPalette& palette) {
  return drawn(palette, [](QPainter& painter) {
    QPen pen = painter.pen();
    pen.setDashPattern({1.6, 1.8});
    painter.setPen(pen);
    painter.drawRect(QRectF(1.2, 1.2, 13.6, 13.6));
    painter.setPen(QPen(colours::selected, 1.6));
    painter.drawEllipse(QPointF(8, 8), 2.8, 2.8);
  });
}

}  // namespace chainmail::tool_icons
