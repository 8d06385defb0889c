#pragma once

#include <QColor>
#include <QVector3D>
#include <QVector4D>
#include <algorithm>
#include <cmath>

#include "common/colours.h"

namespace chainmail {

/// The light on faces in space: light from all sides, light from the sky above, and a key light at the upper left of
/// the viewer. The same formula is in resources/shaders/object.frag. Directions are in view space; the brightness is a
/// factor of the colour, near 1 at most.
struct Lighting {
  float everywhere = 1, sky = 0, key = 0;
  /// Light from behind on faces that are seen edge-on, as a fraction of white. If negative, these faces are darker.
  float edge = 0;
  float glint = 0;  // of a shiny surface, as a fraction of white

  /// Returns the light on objects of one colour, on the current ground.
  static Lighting onGround() {
    return colours::ground() == colours::Ground::dark ? Lighting{0.44F, 0.18F, 0.56F, 0.25F, 0.14F}
                                                      : Lighting{0.46F, 0.16F, 0.42F, -0.30F, 0.10F};
  }
  /// Returns weaker light without highlights, so that colours which stand for values read the same as in the legend.
  static Lighting ofValues() { return {0.80F, 0.08F, 0.26F, 0, 0}; }

  QVector4D shares() const { return {everywhere, sky, key, edge}; }

  /// Returns the colour of a lit face; `normal` has length 1 and points to the viewer.
  QColor of(const QColor& colour, const QVector3D& normal) const {
    const float toLight = QVector3D::dotProduct(normal, QVector3D(-0.42F, 0.58F, 0.70F).normalized());
    const QVector3D halfway = (QVector3D(-0.42F, 0.58F, 0.70F).normalized() + QVector3D(0, 0, 1)).normalized();
    const float mirrored = std::max(0.0F, QVector3D::dotProduct(normal, halfway));
    const float grazing = 1 - std::clamp(normal.z(), 0.0F, 1.0F);
    const float brightness = everywhere + sky * (0.5F + 0.5F * normal.y()) + key * std::max(0.0F, toLight);
    const float rim = edge * std::pow(grazing, 3.0F);
    const float shine = glint * std::pow(mirrored, 32.0F);
    const auto channelOf = [&](float channel) {
      const float plain = channel * brightness;
      const float rimmed = rim > 0 ? plain + rim * (1 - plain) : plain * (1 + rim);
      return std::clamp(rimmed + shine, 0.0F, 1.0F);
    };
    return QColor::fromRgbF(channelOf(colour.redF()), channelOf(colour.greenF()), channelOf(colour.blueF()),
                            colour.alphaF());
  }
};

}  // namespace chainmail
