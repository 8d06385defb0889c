// The values that colour an object, on the graphics card: a texture for links, an attribute for elements.

#include <algorithm>

#include "drawing/colour_map.h"
#include "drawing/object_painter.h"
#include "drawing/upload.h"

namespace chainmail {

void ObjectPainter::useValues(const Scene& scene, const Paint& paint, int shading) {
  const bool ofLinks = paint.values->ofLinks;
  positions_.bind();
  use(scene, paint.colour, shading, mesh_->space_dimension, ofLinks ? 2 : 1);
  if (paint.values->number != valuesNumber_) {
    uploadValues(*paint.values);
  }
  useMap(paint.scale);
  if (ofLinks) {
    glBindTexture(GL_TEXTURE_BUFFER, valuesTexture_);
  } else {
    values_.bind();
    program_->enableAttributeArray(1);
    program_->setAttributeBuffer(1, GL_FLOAT, 0, 1);
  }
}

/// The colour map, for a program that takes its colours from values.
void ObjectPainter::useMap(const ColourScale& scale) {
  const auto& map = colour_map::stopsOf(scale);
  std::array<QVector3D, std::tuple_size_v<colour_map::Stops>> stops;
  std::transform(map.begin(), map.end(), stops.begin(),
                 [](const auto& stop) { return QVector3D(float(stop[0]), float(stop[1]), float(stop[2])) / 255; });
  program_->setUniformValueArray("stops", stops.data(), int(stops.size()));
  program_->setUniformValue("range", QVector2D(scale.lowest, scale.highest));
  program_->setUniformValue("threshold", scale.threshold);
  program_->setUniformValue("neutral", QColor(colour_map::neutral));
}

/// A value for each link that is drawn, or for each element.
void ObjectPainter::uploadValues(const ColourValues& values) {
  valuesNumber_ = values.number;
  if (!values.ofLinks) {
    upload(values_, values.values);
    return;
  }
  upload(values_, parts_.valuesOf(drawnLinks_, values));
  glBindTexture(GL_TEXTURE_BUFFER, valuesTexture_);
  glTexBuffer(GL_TEXTURE_BUFFER, GL_R32F, values_.bufferId());
}

}  // namespace chainmail
