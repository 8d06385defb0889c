#include "panels/orientation_cube.h"

#include <QPainter>
#include <algorithm>

#include "common/colours.h"

namespace chainmail {
namespace {

constexpr double fromCorner = 36, halfSide = 15;  // pixels
constexpr float leastVisible = 0.08F;             // faces that are seen more edge-on than this are left out
constexpr float leastLabelled = 0.45F;
constexpr int labelPixels = 11;

}  // namespace

OrientationCube::OrientationCube(const Camera& camera, QSizeF view) {
  if (!camera.spatial()) {
    return;
  }
  const QMatrix4x4 toView = camera.toView();
  const QPointF middle(view.width() - fromCorner, fromCorner);
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool positive : {false, true}) {
      QVector3D normal, along, across;
      normal[axis] = positive ? 1.0F : -1.0F;
      along[(axis + 1) % 3] = 1;
      across[(axis + 2) % 3] = 1;
      Face face{axis, positive, {}, toView.mapVector(normal).z()};
      for (const auto& [a, b] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)}) {
        const QVector3D at = toView.mapVector(normal + float(a) * along + float(b) * across);
        face.corners << middle + halfSide * QPointF(double(at.x()), -double(at.y()));
      }
      if (face.towardsViewer > leastVisible) {
        faces_.push_back(face);
      }
    }
  }
}

std::optional<OrientationCube::Face> OrientationCube::faceAt(QPointF position) const {
  const auto found = std::ranges::find_if(
      faces_, [&](const Face& face) { return face.corners.containsPoint(position, Qt::OddEvenFill); });
  return found == faces_.end() ? std::nullopt : std::optional(*found);
}

void OrientationCube::draw(QPainter& painter) const {
  painter.setRenderHint(QPainter::Antialiasing);
  QFont font = painter.font();
  font.setPixelSize(labelPixels);
  font.setBold(true);
  painter.setFont(font);
  const QColor ground = colours::background, ink = colours::marked;
  const auto mixed = [&](float share) {
    return QColor::fromRgbF(ground.redF() + share * (ink.redF() - ground.redF()),
                            ground.greenF() + share * (ink.greenF() - ground.greenF()),
                            ground.blueF() + share * (ink.blueF() - ground.blueF()));
  };
  for (const Face& face : faces_) {
    painter.setPen(QPen(mixed(0.6F), 1));
    painter.setBrush(mixed(0.12F + 0.18F * face.towardsViewer));
    painter.drawPolygon(face.corners);
    if (face.towardsViewer > leastLabelled) {
      painter.setPen(ink);
      const QString name = (face.positive ? QString() : QStringLiteral("−")) + QStringLiteral("xyz")[face.axis];
      painter.drawText(face.corners.boundingRect(), Qt::AlignCenter, name);
    }
  }
}

}  // namespace chainmail
