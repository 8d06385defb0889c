#include "docks/report/report_looks.h"

#include <QPainter>
#include <QPainterPath>
#include <QPolygonF>
#include <algorithm>
#include <array>

#include "common/colours.h"
#include "common/text.h"

namespace chainmail {
namespace {

/// The shape about (0, 0), within a square of side 2.8.
using Shape = QPolygonF (*)();

QPolygonF square() { return QRectF(-0.9, -0.9, 1.8, 1.8); }
QPolygonF triangle() { return QList<QPointF>{{0, -1.2}, {1.15, 0.85}, {-1.15, 0.85}}; }
QPolygonF circle() {
  QPainterPath path;
  path.addEllipse(QPointF(), 1, 1);
  return path.toFillPolygon(QTransform::fromScale(50, 50)) * QTransform::fromScale(0.02, 0.02);
}
QPolygonF onItsTip() { return QList<QPointF>{{0, 1.2}, {1.15, -0.85}, {-1.15, -0.85}}; }
QPolygonF cross() {
  return QList<QPointF>{{-0.4, -1.1}, {0.4, -1.1}, {0.4, -0.4}, {1.1, -0.4}, {1.1, 0.4},   {0.4, 0.4},
                        {0.4, 1.1},   {-0.4, 1.1}, {-0.4, 0.4}, {-1.1, 0.4}, {-1.1, -0.4}, {-0.4, -0.4}};
}
QPolygonF diamond() { return QList<QPointF>{{0, -1.4}, {1.1, 0}, {0, 1.4}, {-1.1, 0}}; }
QPolygonF bar() { return QRectF(-1.2, -0.55, 2.4, 1.1); }

struct Look {
  Shape shape;
  colours::Colour colour;
};
constexpr std::array looks{Look{square, {0xffd55e00, 0xffc04a00}}, Look{triangle, {0xff56b4e9, 0xff0f7cb8}},
                           Look{circle, {0xff2a86d1, 0xff00468c}}, Look{onItsTip, {0xff009e73, 0xff007a58}},
                           Look{cross, {0xffcc79a7, 0xffa83a80}},  Look{diamond, {0xffffffff, 0xff101418}},
                           Look{bar, {0xfff0e442, 0xff857000}}};

const Look& lookOf(Algorithm algorithm) {
  const auto all = algorithms();
  const auto at = std::ranges::find(all, algorithm, &AlgorithmInfo::algorithm) - all.begin();
  return looks[std::size_t(at) % looks.size()];
}

}  // namespace

QColor reportColour(Algorithm algorithm) { return lookOf(algorithm).colour; }

QString reportName(const report::Contestant& contestant) {
  const QString name = text(report::label(contestant));
  // '3D' alone would say nothing.
  return contestant.algorithm == Algorithm::chainmail_3d ? name : QString(name).remove(QStringLiteral(" ChainMail"));
}

QPixmap reportMark(const report::Contestant& contestant, int size, double devicePixelRatio) {
  constexpr double side = 3.2;  // of the square, in the shape's own units: room for the pen
  const Look& look = lookOf(contestant.algorithm);
  QPixmap picture(QSize(size, size) * devicePixelRatio);
  picture.setDevicePixelRatio(devicePixelRatio);
  picture.fill(Qt::transparent);
  QPainter painter(&picture);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.translate(size / 2.0, size / 2.0);
  painter.scale(size / side, size / side);
  painter.setPen(QPen(QColor(look.colour), 0.4));
  painter.setBrush(contestant.sweeps == 0 ? QBrush(QColor(look.colour)) : QBrush(Qt::NoBrush));
  painter.drawPolygon(look.shape());
  return picture;
}

}  // namespace chainmail
