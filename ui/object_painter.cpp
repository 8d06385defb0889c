#include "object_painter.h"

#include <algorithm>
#include <cmath>

#include "drawn_indices.h"
#include "mesh/error.h"
#include "picking.h"

namespace chainmail {
namespace {

// Above this many links an object is drawn more coarsely where its links fall below this many pixels.
constexpr LinkId linksDrawnAlways = 60'000;
constexpr double pixelsPerLink = 3;
constexpr LinkId linksOfVolume = 200'000;
// Elements are marked where there are few and they stand apart.
constexpr ElementId elementsMarked = 20'000;
constexpr double pixelsBetweenMarks = 9;
// Smooth lines cost about twice as much; beyond this many links nobody sees the difference.
constexpr GLsizei indicesSmoothed = 60'000;

constexpr float litWidth = 3;  // pixels, where the driver draws wide lines

QVector4D asVector(QColor colour) { return {colour.redF(), colour.greenF(), colour.blueF(), colour.alphaF()}; }

/// Sends data to the graphics card; returns how many there are.
template <class Datum>
GLsizei upload(QOpenGLBuffer& buffer, const std::vector<Datum>& data) {
  buffer.bind();
  buffer.allocate(data.data(), int(data.size() * sizeof(Datum)));
  return GLsizei(data.size());
}

}  // namespace

void ObjectPainter::initialize() {
  initializeOpenGLFunctions();
  const bool built = program_.addShaderFromSourceFile(QOpenGLShader::Vertex, ":/shaders/object.vert") &&
                     program_.addShaderFromSourceFile(QOpenGLShader::Fragment, ":/shaders/object.frag") &&
                     program_.link();
  if (!built) {
    throw Error("OpenGL", program_.log().simplified().toStdString(), "update the graphics driver");
  }
  vertexArray_.create();
  for (QOpenGLBuffer* buffer : {&positions_, &scratch_, &links_, &coarse_, &faces_}) {
    buffer->create();
    buffer->setUsagePattern(QOpenGLBuffer::DynamicDraw);
  }
}

void ObjectPainter::destroy() {
  program_.removeAllShaders();
  vertexArray_.destroy();
  for (QOpenGLBuffer* buffer : {&positions_, &scratch_, &links_, &coarse_, &faces_}) {
    buffer->destroy();
  }
  mesh_.reset();
  frameNumber_ = 0;
}

void ObjectPainter::setFrame(const Frame& frame, const Cuts& cuts) {
  frame_ = &frame;
  if (frame.mesh != mesh_) {
    setMesh(frame.mesh, cuts);
  }
  if (frame.number != frameNumber_) {
    frameNumber_ = frame.number;
    upload(positions_, frame.positions);
  }
}

void ObjectPainter::setCuts(const Cuts& cuts) {
  cuts_ = cuts;
  coarseStep_ = 0;
  linksOutdated_ = facesOutdated_ = true;
}

void ObjectPainter::setMesh(const MeshPointer& mesh, const Cuts& cuts) {
  mesh_ = mesh;
  frameNumber_ = 0;
  setCuts(cuts);
}

void ObjectPainter::chooseStep(double pixelsPerUnit) {
  step_ = 1;
  const double pixels = mesh_->mean_link_length * pixelsPerUnit;
  if (mesh_->link_count() <= linksDrawnAlways || !(pixels > 0)) {
    return;
  }
  // Inside a volume links hide each other: it is drawn coarsely before they become too small.
  const bool volume = mesh_->object_dimension == 3 && mesh_->lattice;
  const auto tooMany = [&] { return volume && mesh_->link_count() / (step_ * step_ * step_) > linksOfVolume; };
  while (step_ < 64 && (pixels * step_ < pixelsPerLink || tooMany())) {
    step_ *= 2;
  }
  if (step_ > 1 && step_ != coarseStep_) {
    coarseStep_ = step_;
    coarseIndices_ = upload(coarse_, mesh_->lattice ? coarseLinks(*mesh_, cuts_, step_) : scattered(*mesh_, step_));
  }
}

void ObjectPainter::use(const Scene& scene, QColor colour, int shading, int dimension) {
  glEnable(GL_PROGRAM_POINT_SIZE);
  glEnable(GL_BLEND);
  // The picture stays opaque, whatever is blended into it.
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  program_.bind();
  program_.setUniformValue("to_view", scene.toView * placement(*mesh_));
  program_.setUniformValue("to_clip", scene.toClip);
  program_.setUniformValue("colour", asVector(colour));
  program_.setUniformValue("background", asVector(scene.background));
  program_.setUniformValue("fog", scene.fog);
  program_.setUniformValue("shading", shading);
  vertexArray_.bind();
  program_.enableAttributeArray(0);
  program_.setAttributeBuffer(0, GL_FLOAT, 0, dimension);
}

void ObjectPainter::drawObject(const Scene& scene, QColor colour, double pixelsPerUnit) {
  chooseStep(pixelsPerUnit);
  drawFaces(scene, colour);
  drawWires(scene, colour);
  if (step_ == 1 && mesh_->element_count() <= elementsMarked &&
      mesh_->mean_link_length * pixelsPerUnit >= pixelsBetweenMarks * scene.pixelRatio) {
    positions_.bind();
    use(scene, colour.lighter(125), 2, mesh_->space_dimension);
    program_.setUniformValue("point_size", 4.5F * scene.pixelRatio);
    glDrawArrays(GL_POINTS, 0, GLsizei(mesh_->element_count()));
  }
  vertexArray_.release();
}

void ObjectPainter::drawFaces(const Scene& scene, QColor colour) {
  const bool spatial = mesh_->space_dimension == 3;
  if (step_ > 1 && !spatial) {
    return;  // they only tint a plane, and there are many
  }
  if (facesOutdated_) {
    faceIndices_ = upload(faces_, uncutFaces(*mesh_, cuts_));
    facesOutdated_ = false;
  }
  if (faceIndices_ == 0) {
    return;
  }
  if (spatial) {
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1, 1);
  }
  positions_.bind();
  // A plane object's faces are only hinted at; in space they hide what lies behind them.
  QColor face = colour.darker(spatial ? 320 : 100);
  face.setAlphaF(spatial ? 1.0F : 0.08F);
  use(scene, face, spatial ? 1 : 0, mesh_->space_dimension);
  faces_.bind();
  glDrawElements(GL_TRIANGLES, faceIndices_, GL_UNSIGNED_INT, nullptr);
  glDisable(GL_POLYGON_OFFSET_FILL);
}

void ObjectPainter::drawWires(const Scene& scene, QColor colour) {
  const bool coarse = step_ > 1;
  if (!coarse && linksOutdated_) {
    linkIndices_ = upload(links_, uncutLinks(*mesh_, cuts_));
    linksOutdated_ = false;
  }
  const GLsizei count = coarse ? coarseIndices_ : linkIndices_;
  positions_.bind();
  use(scene, colour, 0, mesh_->space_dimension);
  (coarse ? coarse_ : links_).bind();
  if (coarse && !mesh_->lattice) {
    program_.setUniformValue("point_size", scene.pixelRatio);
    glDrawElements(GL_POINTS, count, GL_UNSIGNED_INT, nullptr);
    return;
  }
  if (count <= indicesSmoothed) {
    glEnable(GL_LINE_SMOOTH);
  }
  glDrawElements(GL_LINES, count, GL_UNSIGNED_INT, nullptr);
  glDisable(GL_LINE_SMOOTH);
}

void ObjectPainter::drawElements(const Scene& scene, std::span<const ElementId> elements, QColor colour,
                                 float diameter) {
  std::vector<float> places;
  for (const ElementId e : elements) {
    const float* at = frame_->positions.data() + std::size_t{e} * mesh_->space_dimension;
    places.insert(places.end(), at, at + mesh_->space_dimension);
  }
  drawOwn(scene, places, GL_POINTS, colour, 2, diameter);
}

void ObjectPainter::drawLinks(const Scene& scene, std::span<const LinkId> links, QColor colour) {
  std::vector<float> places;
  for (const LinkId link : links) {
    for (const ElementId e : mesh_->links[link]) {
      const float* at = frame_->positions.data() + std::size_t{e} * mesh_->space_dimension;
      places.insert(places.end(), at, at + mesh_->space_dimension);
    }
  }
  glLineWidth(litWidth * scene.pixelRatio);
  drawOwn(scene, places, GL_LINES, colour, 0, 1);
  glLineWidth(1);
}

/// Draws positions that are not the object's buffer, over everything else.
void ObjectPainter::drawOwn(const Scene& scene, std::span<const float> positions, GLenum mode, QColor colour,
                            int shading, float diameter) {
  if (positions.empty()) {
    return;
  }
  glDisable(GL_DEPTH_TEST);
  scratch_.bind();
  scratch_.allocate(positions.data(), int(positions.size_bytes()));
  Scene over = scene;
  over.fog = {};
  use(over, colour, shading, mesh_->space_dimension);
  program_.setUniformValue("point_size", diameter * scene.pixelRatio);
  glDrawArrays(mode, 0, GLsizei(positions.size() / mesh_->space_dimension));
  vertexArray_.release();
}

void ObjectPainter::drawStroke(const Scene& scene, std::span<const QPointF> places, QColor colour) {
  if (places.size() < 2) {
    return;
  }
  std::vector<float> device;
  for (const QPointF& place : places) {
    device.push_back(float(2 * place.x() * scene.pixelRatio / scene.size.width() - 1));
    device.push_back(float(1 - 2 * place.y() * scene.pixelRatio / scene.size.height()));
  }
  glDisable(GL_DEPTH_TEST);
  scratch_.bind();
  scratch_.allocate(device.data(), int(device.size() * sizeof(float)));
  use(scene, colour, 0, 2);
  program_.setUniformValue("to_view", QMatrix4x4());
  program_.setUniformValue("to_clip", QMatrix4x4());
  glDrawArrays(GL_LINE_STRIP, 0, GLsizei(places.size()));
  vertexArray_.release();
}

}  // namespace chainmail
