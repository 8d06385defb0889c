// What goes with the material: a section through the object at rest, and textures.

#include <QVector4D>
#include <algorithm>

#include "common/colours.h"
#include "drawing/object_painter.h"
#include "drawing/upload.h"

namespace chainmail {
namespace {

/// Rest positions as floats hold them whatever the origin: in lengths of the box's longest side, from its lowest
/// corner.
double unitOf(const Mesh& mesh) {
  const double longest = (mesh.box[1] - mesh.box[0]).maxCoeff();
  return longest > 0 ? longest : 1;
}

QVector3D atRest(const Mesh& mesh, const Point& rest) {
  const Point place = (rest - mesh.box[0]) / unitOf(mesh);
  return {float(place.x()), float(place.y()), float(place.z())};
}

std::vector<QVector3D> allAtRest(const Mesh& mesh) {
  std::vector<QVector3D> places(mesh.element_count());
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    places[e] = atRest(mesh, mesh.rest_position(e));
  }
  return places;
}

/// Its product with a place at rest and 1 is negative in front of the plane.
QVector4D asVector(const Mesh& mesh, const SectionPlane& plane) {
  const auto sign = plane.flipped ? 1.0F : -1.0F;
  QVector4D vector;
  vector[plane.axis] = sign;
  vector[3] = -sign * float((plane.at - mesh.box[0][plane.axis]) / unitOf(mesh));
  return vector;
}

}  // namespace

/// For what is drawn next of the object's elements.
void ObjectPainter::useRest(const Look& look) {
  const bool pictured = showsPicture(*mesh_);
  if (!look.section && !pictured) {
    return;
  }
  if (restMesh_ != mesh_) {
    upload(rest_, allAtRest(*mesh_));
    restMesh_ = mesh_;
  }
  rest_.bind();
  program_->enableAttributeArray(2);
  program_->setAttributeBuffer(2, GL_FLOAT, 0, 3);
  if (look.section) {
    program_->setUniformValue("section", asVector(*mesh_, *look.section));
    glEnable(GL_CLIP_DISTANCE0);
  }
}

/// Binds the mesh's texture for the program in use, sent when it is first shown.
void ObjectPainter::useTexture() {
  const Texture& texture = *mesh_->texture;
  if (texture_ == nullptr) {
    texture_ = parts_.levels().textures().of(mesh_->texture);
  }
  texture_->bind();
  QVector3D scale, offset;
  for (int k = 0; k < 3; ++k) {
    const double size = texture.box[1][k] - texture.box[0][k];
    scale[k] = size > 0 ? float(unitOf(*mesh_) / size) : 0;
    offset[k] = size > 0 ? float((mesh_->box[0][k] - texture.box[0][k]) / size) : 0.5F;
  }
  program_->setUniformValue("texture_scale", scale);
  program_->setUniformValue("texture_offset", offset);
}

/// The section's face. Its points are those of the newest frame, at the cost of these alone.
void ObjectPainter::drawCap(const Scene& scene, const Paint& paint) {
  const Section* section = parts_.section();
  if (section == nullptr) {
    return;
  }
  if (parts_.takeSectionChange()) {
    capIndices_ = upload(cap_, section->triangles(parts_.surface()));
    std::vector<QVector3D> rest(section->points().size());
    std::ranges::transform(section->points(), rest.begin(), [this](const SectionPoint& point) {
      const Point from = mesh_->rest_position(point.from);
      return atRest(*mesh_, from + double(point.share) * (mesh_->rest_position(point.to) - from));
    });
    upload(capRest_, rest);
    capMoved_ = true;
  }
  if (std::exchange(capMoved_, false)) {
    upload(capPlaces_, placesOf(*section, *frame_));
  }
  const bool sliced = showsSlices(*mesh_);
  capPlaces_.bind();
  use(scene, sectionColour(*mesh_, paint), sliced ? 0 : 1, 3, sliced ? 4 : 0);
  if (sliced) {
    useTexture();
    capRest_.bind();
    program_->enableAttributeArray(2);
    program_->setAttributeBuffer(2, GL_FLOAT, 0, 3);
  }
  cap_.bind();
  glDrawElements(GL_TRIANGLES, capIndices_, GL_UNSIGNED_INT, nullptr);
}

}  // namespace chainmail
