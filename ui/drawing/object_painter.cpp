#include "drawing/object_painter.h"

#include <QFile>
#include <algorithm>

#include "common/colours.h"
#include "drawing/colour_map.h"
#include "drawing/projection.h"
#include "drawing/upload.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

// Smooth lines cost about twice as much; beyond this many links nobody sees the difference.
constexpr GLsizei indicesSmoothed = 30'000;

QVector4D asVector(QColor colour) { return {colour.redF(), colour.greenF(), colour.blueF(), colour.alphaF()}; }

void build(QOpenGLShaderProgram& program, const std::array<int, 2>& variant) {
  const QByteArray head = "#version 330 core\n#define SHADING " + QByteArray::number(variant[0]) +
                          "\n#define COLOURED_BY " + QByteArray::number(variant[1]) + "\n";
  const auto source = [&head](const char* name) {
    QFile file(QLatin1String(":/shaders/") + QLatin1String(name));
    return file.open(QIODevice::ReadOnly) ? head + file.readAll() : QByteArray();
  };
  if (!(program.addShaderFromSourceCode(QOpenGLShader::Vertex, source("object.vert")) &&
        program.addShaderFromSourceCode(QOpenGLShader::Fragment, source("object.frag")) && program.link())) {
    throw Error("OpenGL", program.log().simplified().toStdString(), "update the graphics driver");
  }
}

}  // namespace

void ObjectPainter::initialize() {
  initializeOpenGLFunctions();
  for (std::size_t i = 0; i < variants.size(); ++i) {
    build(programs_[i], variants[i]);
  }
  vertexArray_.create();
  for (QOpenGLBuffer* buffer : buffers()) {
    buffer->create();
    buffer->setUsagePattern(QOpenGLBuffer::DynamicDraw);
  }
  glGenTextures(1, &valuesTexture_);
}

void ObjectPainter::destroy() {
  for (QOpenGLShaderProgram& program : programs_) {
    program.removeAllShaders();
  }
  vertexArray_.destroy();
  glDeleteTextures(1, &valuesTexture_);
  for (QOpenGLBuffer* buffer : buffers()) {
    buffer->destroy();
  }
  mesh_.reset();
  restMesh_.reset();
  texture_.reset();
  parts_.forget();
  seeThrough_.destroy();
  frameNumber_ = 0;
  valuesNumber_ = 0;
  selectedIndices_ = 0;
}

void ObjectPainter::setFrame(const Frame& frame, const Cuts& cuts) {
  frame_ = &frame;
  parts_.setFrame(frame, cuts);
  if (frame.series != frameSeries_) {
    frameSeries_ = frame.series;
    frameNumber_ = 0;
  }
  if (frame.mesh != mesh_) {
    mesh_ = frame.mesh;
    texture_.reset();
    frameNumber_ = 0;
    selectedIndices_ = 0;
    valuesNumber_ = 0;
  }
  if (frame.number != frameNumber_) {
    uploadPositions(frame);
    frameNumber_ = frame.number;
    capMoved_ = true;
  }
}

/// Runs of blocks that changed since the last time; all at once where all are new.
void ObjectPainter::uploadPositions(const Frame& frame) {
  if (frameNumber_ == 0) {
    upload(positions_, frame.positions);
    return;
  }
  const std::size_t perBlock = std::size_t{Frame::block_elements} * mesh_->space_dimension;
  const auto& changed = frame.changed;
  for (std::size_t block = 0; block < changed.size(); ++block) {
    const std::size_t first = block;
    while (block < changed.size() && changed[block] > frameNumber_) {
      ++block;
    }
    if (block > first) {
      uploadPart(positions_, frame.positions, first * perBlock, std::min(block * perBlock, frame.positions.size()));
    }
  }
}

void ObjectPainter::use(const Scene& scene, QColor colour, int shading, int dimension, int colouredBy) {
  glEnable(GL_PROGRAM_POINT_SIZE);
  glEnable(GL_BLEND);
  // The picture stays opaque, whatever is blended into it.
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  const std::array variant{shading, colouredBy};
  program_ = &programs_[std::size_t(std::find(variants.begin(), variants.end(), variant) - variants.begin())];
  program_->bind();
  program_->setUniformValue("to_view", scene.toView * placement(*mesh_));
  program_->setUniformValue("to_clip", scene.toClip);
  program_->setUniformValue("colour", asVector(colour));
  program_->setUniformValue("background", asVector(scene.background));
  program_->setUniformValue("fog", scene.fog);
  program_->setUniformValue("darkest", darkestFace(look_));
  program_->setUniformValue("section",
                            QVector4D(0, 0, 0, 1));  // takes nothing away, whatever the driver has switched on
  vertexArray_.bind();
  program_->enableAttributeArray(0);
  program_->setAttributeBuffer(0, GL_FLOAT, 0, dimension);
  program_->disableAttributeArray(1);
  program_->disableAttributeArray(2);
}

void ObjectPainter::drawObject(const Scene& scene, const Paint& wanted, double pixelsPerUnit) {
  if (parts_.choose(scene, wanted, pixelsPerUnit)) {
    sendParts();
  }
  Paint paint = wanted;
  paint.look.links = paint.look.links && !leavesLinksOut();
  look_ = paint.look;
  drawFaces(scene, paint);
  drawWires(scene, paint);
  if (paint.look.links && step() == 1 && marksElements(*mesh_, pixelsPerUnit)) {
    drawEveryElement(scene, paint);
  }
  glDisable(GL_CLIP_DISTANCE0);
  vertexArray_.release();
}

void ObjectPainter::sendParts() {
  auto drawn = parts_.links();
  drawnLinks_ = std::move(drawn.numbers);
  upload(links_, drawn.ends);
  faceIndices_ = upload(faces_, parts_.faces());
  valuesNumber_ = 0;
}

void ObjectPainter::drawEveryElement(const Scene& scene, const Paint& paint) {
  const bool byValues = valuesFit(paint);
  positions_.bind();
  if (byValues && !paint.values->ofLinks) {
    useValues(scene, paint, 2);
  } else {
    use(scene, byValues ? QColor(colour_map::neutral) : colours::stronger(paint.colour), 2, mesh_->space_dimension);
  }
  useRest(paint.look);
  program_->setUniformValue("point_size", elementSize * scene.pixelRatio);
  glDrawArrays(GL_POINTS, 0, GLsizei(mesh_->element_count()));
}

void ObjectPainter::drawFaces(const Scene& scene, const Paint& paint) {
  if (faceIndices_ == 0) {
    return;
  }
  const bool spatial = mesh_->space_dimension == 3;
  if (spatial) {
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1, 1);
  }
  positions_.bind();
  const bool pictured = showsPicture(*mesh_);
  if (facesByValues(mesh_.get(), paint)) {
    useValues(scene, paint, 0);
  } else {
    use(scene, faceColour(*mesh_, paint), spatial && !pictured ? 1 : 0, mesh_->space_dimension, pictured ? 3 : 0);
  }
  if (pictured) {
    useTexture();
  }
  useRest(paint.look);
  faces_.bind();
  glDrawElements(GL_TRIANGLES, faceIndices_, GL_UNSIGNED_INT, nullptr);
  glDisable(GL_CLIP_DISTANCE0);
  drawCap(scene, paint);
  glDisable(GL_POLYGON_OFFSET_FILL);
}

void ObjectPainter::drawWires(const Scene& scene, const Paint& paint) {
  const auto count = GLsizei(2 * drawnLinks_.size());
  if (count == 0) {
    return;
  }
  positions_.bind();
  if (!valuesFit(paint)) {
    use(scene, paint.colour, 0, mesh_->space_dimension);
  } else {
    useValues(scene, paint, 0);
  }
  useRest(paint.look);
  links_.bind();
  if (count <= indicesSmoothed) {
    glLineWidth((valuesFit(paint) ? valuedWidth : 1) * scene.pixelRatio);  // as wide on every screen
    glEnable(GL_LINE_SMOOTH);
  }
  glDrawElements(GL_LINES, count, GL_UNSIGNED_INT, nullptr);
  glDisable(GL_LINE_SMOOTH);
  glLineWidth(1);
}

}  // namespace chainmail
