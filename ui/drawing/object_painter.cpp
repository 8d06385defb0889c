// The order of this file: set-up, frames, shader state, the object, marks and shapes over it.

#include "drawing/object_painter.h"

#include <QOpenGLPaintDevice>
#include <QPainter>
#include <QVector4D>
#include <algorithm>

#include "common/colours.h"
#include "drawing/colour_map.h"
#include "drawing/drawn_parts.h"
#include "drawing/object_layer.h"
#include "drawing/projection.h"

namespace chainmail {
namespace {

// Lines with more indices than this are not smoothed. Smooth lines take about twice as long, and the difference would
// not be visible.
constexpr GLsizei maxIndicesSmoothed = 30'000;
// More rings would hide each other and take time.
constexpr std::size_t maxRingsPainted = 50'000;
// Valued shapes are drawn nearer to the eye by this fraction of the object's depth, so that faces next to them do not
// hide parts of them.
constexpr float valuedLift = 0.04F;
// The same for links that are drawn again over the others.
constexpr float thickLift = 0.01F;
// The same for marks, so that the surface around a marked element does not hide its mark.
constexpr float markLift = 0.03F;
constexpr float hiddenOpacity = 0.3F;  // of marks behind the surface
// Surfaces within this fraction of the object's depth may hide light from each other.
constexpr float occlusionReach = 0.09F;
constexpr float occlusionDarkening = 0.75F;

/// Sends data to the graphics card; returns the number of items.
template <class Datum>
int upload(QOpenGLBuffer& buffer, const std::vector<Datum>& data) {
  buffer.bind();
  buffer.allocate(data.data(), int(data.size() * sizeof(Datum)));
  return int(data.size());
}

/// Sends the items from `first` to `end` into a buffer that already contains all of them.
template <class Datum>
void uploadPart(QOpenGLBuffer& buffer, const std::vector<Datum>& data, std::size_t first, std::size_t end) {
  buffer.bind();
  buffer.write(int(first * sizeof(Datum)), data.data() + first, int((end - first) * sizeof(Datum)));
}

QVector4D rgbaOf(QColor colour) { return {colour.redF(), colour.greenF(), colour.blueF(), colour.alphaF()}; }

/// Returns the unit of scaled rest positions: the longest side of the mesh's box (mesh units).
double restUnit(const Mesh& mesh) {
  const double longest = (mesh.box[1] - mesh.box[0]).maxCoeff();
  return longest > 0 ? longest : 1;
}

/// Returns a rest position relative to the lowest corner of the mesh's box, scaled to at most 1. So floats are precise
/// enough, wherever the mesh lies.
QVector3D scaledRest(const Mesh& mesh, const Point& rest) {
  const Point scaled = (rest - mesh.box[0]) / restUnit(mesh);
  return {float(scaled.x()), float(scaled.y()), float(scaled.z())};
}

std::vector<QVector3D> allScaledRests(const Mesh& mesh) {
  std::vector<QVector3D> positions(mesh.element_count());
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    positions[e] = scaledRest(mesh, mesh.rest_position(e));
  }
  return positions;
}

/// Returns the plane of the section as a vector. Its dot product with (scaled rest position, 1) is negative in front of
/// the section.
QVector4D sectionVector(const Mesh& mesh, const SectionPlane& plane) {
  const auto sign = plane.flipped ? 1.0F : -1.0F;
  QVector4D vector;
  vector[plane.axis] = sign;
  vector[3] = -sign * float((plane.at - mesh.box[0][plane.axis]) / restUnit(mesh));
  return vector;
}

/// Returns a projection to the same positions in the view, but nearer to the eye by a fraction of the object's depth.
QMatrix4x4 liftedClip(const ObjectDrawing::Scene& scene, float lift) {
  if (scene.fog.y() <= scene.fog.x()) {
    return scene.toClip;
  }
  const float middle = (scene.fog.x() + scene.fog.y()) / 2;
  const float nearer = middle - lift * (scene.fog.y() - scene.fog.x());
  QMatrix4x4 shift;
  shift(2, 3) = scene.toClip.map(QVector3D(0, 0, -nearer)).z() - scene.toClip.map(QVector3D(0, 0, -middle)).z();
  return shift * scene.toClip;
}

/// Returns the scene for marks: without fading, and a little nearer to the eye.
ObjectDrawing::Scene overObject(const ObjectDrawing::Scene& scene) {
  ObjectDrawing::Scene over = scene;
  over.toClip = scene.hidesMarks ? liftedClip(scene, markLift) : scene.toClip;
  over.fog = {};
  return over;
}

}  // namespace

// Set-up

void ObjectPainter::initialize() {
  initializeOpenGLFunctions();
  for (std::size_t i = 0; i < variants.size(); ++i) {
    buildProgram(programs_[i], "object.vert", "object.frag", definitions(variants[i]));
  }
  layer_.initialize();
  inLayer_ = {};
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
  layer_.destroy();
  glDeleteTextures(1, &valuesTexture_);
  for (QOpenGLBuffer* buffer : buffers()) {
    buffer->destroy();
  }
  seeThrough_.destroy();
  startOver();
}

void ObjectPainter::startOver() {
  mesh_.reset();
  restMesh_.reset();
  texture_.reset();
  parts_.forget();
  inLayer_ = {};
  frameNumber_ = 0;
  valuesNumber_ = 0;
  selectedIndices_ = 0;
}

// Frames

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
    frontSign_ = mesh_->space_dimension == 2 ? frontSign(*mesh_) : 0;
  }
  if (frame.number != frameNumber_) {
    uploadPositions(frame);
    frameNumber_ = frame.number;
    capMoved_ = true;
  }
}

/// Sends the runs of blocks that changed since the last frame, or all blocks of a new object.
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

// Shader state

QByteArray ObjectPainter::definitions(const Variant& variant) {
  return "#define SHADING " + QByteArray::number(int(variant.shading)) + "\n#define COLOURED_BY " +
         QByteArray::number(int(variant.colouring)) + "\n";
}

ObjectPainter::Shading ObjectPainter::shadingOf(Mark mark) {
  return mark == Mark::disc ? Shading::disc : mark == Mark::diamond ? Shading::diamond : Shading::ring;
}

/// Prepares the next draw call, which takes its positions from the bound buffer.
void ObjectPainter::use(const Scene& scene, QColor colour, Shading shading, int dimension, Colouring colouring) {
  glEnable(GL_PROGRAM_POINT_SIZE);
  glEnable(GL_BLEND);
  // The picture stays opaque: blending does not lower its alpha.
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  const Variant variant{shading, colouring};
  program_ = &programs_[std::size_t(std::find(variants.begin(), variants.end(), variant) - variants.begin())];
  program_->bind();
  program_->setUniformValue("to_view", scene.toView * meshToWorld(*mesh_));
  program_->setUniformValue("to_clip", scene.toClip);
  program_->setUniformValue("colour", rgbaOf(colour));
  program_->setUniformValue("background", rgbaOf(scene.background));
  program_->setUniformValue("fog", scene.fog);
  program_->setUniformValue("fade", fade_);
  program_->setUniformValue("light", lighting_.shares());
  program_->setUniformValue("glint", lighting_.glint);
  program_->setUniformValue("section", QVector4D(0, 0, 0, 1));  // clips nothing, even if the driver always clips
  vertexArray_.bind();
  program_->enableAttributeArray(0);
  program_->setAttributeBuffer(0, GL_FLOAT, 0, dimension);
  program_->disableAttributeArray(1);
  program_->disableAttributeArray(2);
  program_->disableAttributeArray(3);
}

/// Same as use(), for the object coloured by its values: elements read them as an attribute, links from a texture.
void ObjectPainter::useValues(const Scene& scene, const Paint& paint, Shading shading, bool ofLinks) {
  positions_.bind();
  use(scene, paint.colour, shading, mesh_->space_dimension, ofLinks ? Colouring::links : Colouring::elements);
  if (paint.values->number != valuesNumber_) {
    uploadValues(paint);
  }
  useMap(paint.scale, colour_map::neutral);
  if (ofLinks) {
    program_->setUniformValue("first_value", 0);
    glBindTexture(GL_TEXTURE_BUFFER, valuesTexture_);
  } else {
    elementValues_.bind();
    program_->enableAttributeArray(1);
    program_->setAttributeBuffer(1, GL_FLOAT, 0, 1);
  }
}

/// Sends one value per element, or per link that is drawn, and those of the thick links again.
void ObjectPainter::uploadValues(const Paint& paint) {
  valuesNumber_ = paint.values->number;
  upload(elementValues_, elementValues(*paint.values));
  if (!paint.values->ofLinks) {
    return;
  }
  auto values = parts_.valuesOf(drawnLinks_.numbers, *paint.values);
  std::vector<ElementId> ends;
  for (std::size_t i = 0; thickensLinks(mesh_.get(), paint) && i < drawnLinks_.numbers.size(); ++i) {
    if (!paint.scale.isNeutral(values[i])) {
      ends.insert(ends.end(), {drawnLinks_.ends[2 * i], drawnLinks_.ends[2 * i + 1]});
      const float value = values[i];
      values.push_back(value);
    }
  }
  thickIndices_ = upload(thickLinks_, ends);
  upload(values_, values);
  glBindTexture(GL_TEXTURE_BUFFER, valuesTexture_);
  glTexBuffer(GL_TEXTURE_BUFFER, GL_R32F, values_.bufferId());
}

/// Sets the colour map of a program that colours by values.
void ObjectPainter::useMap(const ColourScale& scale, QColor neutral) {
  const auto& map = colour_map::stopsOf(scale);
  std::array<QVector3D, std::tuple_size_v<colour_map::Stops>> stops;
  std::transform(map.begin(), map.end(), stops.begin(),
                 [](const auto& stop) { return QVector3D(float(stop[0]), float(stop[1]), float(stop[2])) / 255; });
  program_->setUniformValueArray("stops", stops.data(), int(stops.size()));
  program_->setUniformValue("range", QVector2D(scale.lowest, scale.highest));
  program_->setUniformValue("threshold", scale.threshold);
  program_->setUniformValue("centre", scale.centre);
  program_->setUniformValue("diverging", scale.diverging);
  program_->setUniformValue("logarithmic", scale.logarithmic);
  program_->setUniformValue("neutral", neutral);
}

/// Passes rest positions to the program in use if a section or a picture needs them, and turns the section on.
void ObjectPainter::useRest(const DrawOptions& options) {
  const bool pictured = showsPicture(*mesh_);
  if (!options.section && !pictured) {
    return;
  }
  if (restMesh_ != mesh_) {
    upload(rest_, allScaledRests(*mesh_));
    restMesh_ = mesh_;
  }
  rest_.bind();
  program_->enableAttributeArray(2);
  program_->setAttributeBuffer(2, GL_FLOAT, 0, 3);
  if (options.section) {
    program_->setUniformValue("section", sectionVector(*mesh_, *options.section));
    glEnable(GL_CLIP_DISTANCE0);
  }
}

/// Binds the mesh's texture for the program in use. Sends it to the graphics card on first use.
void ObjectPainter::useTexture() {
  const Texture& texture = *mesh_->texture;
  if (texture_ == nullptr) {
    texture_ = parts_.levels().textures().of(mesh_->texture);
  }
  texture_->bind();
  QVector3D scale, offset;
  for (int k = 0; k < 3; ++k) {
    const double size = texture.box[1][k] - texture.box[0][k];
    scale[k] = size > 0 ? float(restUnit(*mesh_) / size) : 0;
    offset[k] = size > 0 ? float((mesh_->box[0][k] - texture.box[0][k]) / size) : 0.5F;
  }
  program_->setUniformValue("texture_scale", scale);
  program_->setUniformValue("texture_offset", offset);
}

// The object: faces, section, links, elements

void ObjectPainter::drawObject(const Scene& scene, const Paint& wanted, double pixelsPerUnit) {
  if (parts_.choose(scene, wanted, pixelsPerUnit)) {
    sendParts();
  }
  Paint paint = wanted;
  paint.options.links = paint.options.links && !leavesLinksOut();
  lighting_ = lighting(*mesh_, paint);
  fade_ = fade(*mesh_, paint);
  const bool solid = isSolid(*mesh_, paint.options) && faceIndices_ > 0;
  if (solid) {
    sendNormals();
  }
  if (solid && scene.detail == DetailBudget::Detail::complete) {
    drawInLayer(scene, paint, pixelsPerUnit);
  } else {
    drawParts(scene, paint, pixelsPerUnit);
  }
  glDisable(GL_CLIP_DISTANCE0);
  vertexArray_.release();
}

void ObjectPainter::drawParts(const Scene& scene, const Paint& paint, double pixelsPerUnit) {
  drawFaces(scene, paint);
  drawWires(scene, paint, pixelsPerUnit);
  if (paint.options.links && !isSolid(*mesh_, paint.options) && step() == 1 && marksElements(*mesh_, pixelsPerUnit)) {
    drawEveryElement(scene, paint);
  }
}

/// Draws the object into its layer if it has changed, and copies the layer.
void ObjectPainter::drawInLayer(const Scene& scene, const Paint& paint, double pixelsPerUnit) {
  if (const Drawn now = drawnNow(scene, paint); now != inLayer_) {
    layer_.begin(scene.size.toSize());
    drawParts(scene, paint, pixelsPerUnit);
    glDisable(GL_CLIP_DISTANCE0);
    const bool coloured = facesByValues(mesh_.get(), paint) || showsPicture(*mesh_) || showsSlices(*mesh_);
    layer_.end({scene.toClip, coloured ? 0 : occlusionReach * (scene.fog.y() - scene.fog.x()), occlusionDarkening});
    inLayer_ = now;
    layerDrawn_ = true;
  }
  layer_.copy();
}

ObjectPainter::Drawn ObjectPainter::drawnNow(const Scene& scene, const Paint& paint) const {
  const std::uint64_t parts = partsNumber_ + (parts_.section() != nullptr && parts_.sectionChanged() ? 1 : 0);
  return {scene.toView,
          scene.toClip,
          scene.size,
          scene.fog,
          scene.background,
          paint.colour,
          scene.pixelRatio,
          valuesFit(paint) ? paint.values->number : 0,
          frameNumber_,
          frameSeries_,
          parts,
          paint.scale,
          paint.options};
}

void ObjectPainter::sendParts() {
  drawnLinks_ = parts_.links();
  upload(links_, drawnLinks_.ends);
  faceIndices_ = upload(faces_, parts_.faces());
  freshIndices_ = upload(fresh_, parts_.freshFaces());
  valuesNumber_ = 0;
  normalsOutdated_ = true;
  ++partsNumber_;
}

/// Computes and sends the normals that changed.
void ObjectPainter::sendNormals() {
  if (std::exchange(normalsOutdated_, false)) {
    auto corners = parts_.faces();
    const auto fresh = parts_.freshFaces();
    corners.insert(corners.end(), fresh.begin(), fresh.end());
    normalsOf_.setFaces(std::move(corners), mesh_->element_count());
    upload(normals_, normalsOf_.normals());
  }
  normalsOf_.follow(*frame_);
  for (const auto& [first, end] : normalsOf_.changedBlocks()) {
    const auto& normals = normalsOf_.normals();
    uploadPart(normals_, normals, first * Frame::block_elements, std::min(end * Frame::block_elements, normals.size()));
  }
}

void ObjectPainter::drawFaces(const Scene& scene, const Paint& paint) {
  if (faceIndices_ + freshIndices_ == 0) {
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
  const Shading shading = !spatial ? Shading::plane : pictured ? Shading::plain : Shading::lit;
  if (facesByValues(mesh_.get(), paint)) {
    useValues(scene, paint, shading, false);
  } else {
    use(scene, faceColour(*mesh_, paint), shading, mesh_->space_dimension,
        pictured ? Colouring::picture : Colouring::one);
  }
  if (pictured) {
    useTexture();
  }
  if (spatial) {
    useNormals();
  } else {
    const QMatrix4x4 seen = scene.toView * meshToWorld(*mesh_);
    const bool mirrored = seen(0, 0) * seen(1, 1) < seen(0, 1) * seen(1, 0);
    program_->setUniformValue("front_sign", mirrored ? -frontSign_ : frontSign_);
  }
  useRest(paint.options);
  faces_.bind();
  glDrawElements(GL_TRIANGLES, faceIndices_, GL_UNSIGNED_INT, nullptr);
  drawFresh(scene, paint);
  glDisable(GL_CLIP_DISTANCE0);
  drawCap(scene);
  glDisable(GL_POLYGON_OFFSET_FILL);
}

/// Draws the faces that cuts have made visible in a volume, in the colour of its inside.
void ObjectPainter::drawFresh(const Scene& scene, const Paint& paint) {
  if (freshIndices_ == 0) {
    return;
  }
  if (!facesByValues(mesh_.get(), paint)) {
    positions_.bind();
    use(scene, colours::inner, Shading::lit, 3);
    useNormals();
    useRest(paint.options);
  }
  fresh_.bind();
  glDrawElements(GL_TRIANGLES, freshIndices_, GL_UNSIGNED_INT, nullptr);
}

void ObjectPainter::useNormals() {
  normals_.bind();
  program_->enableAttributeArray(3);
  program_->setAttributeBuffer(3, GL_FLOAT, 0, 3);
}

/// Draws the face of the section. For a new frame, it sends only the points of this face.
void ObjectPainter::drawCap(const Scene& scene) {
  const Section* section = parts_.section();
  if (section == nullptr) {
    return;
  }
  if (parts_.takeSectionChange()) {
    ++partsNumber_;
    capIndices_ = upload(cap_, section->triangles(parts_.surface()));
    std::vector<QVector3D> rest(section->points().size());
    std::ranges::transform(section->points(), rest.begin(), [this](const SectionPoint& point) {
      const Point from = mesh_->rest_position(point.from);
      return scaledRest(*mesh_, from + double(point.share) * (mesh_->rest_position(point.to) - from));
    });
    upload(capRest_, rest);
    capMoved_ = true;
  }
  if (std::exchange(capMoved_, false)) {
    upload(capPositions_, positionsOf(*section, *frame_));
  }
  const bool sliced = showsSlices(*mesh_);
  capPositions_.bind();
  use(scene, colours::inner, sliced ? Shading::plain : Shading::lit, 3, sliced ? Colouring::volume : Colouring::one);
  if (sliced) {
    useTexture();
    capRest_.bind();
    program_->enableAttributeArray(2);
    program_->setAttributeBuffer(2, GL_FLOAT, 0, 3);
  }
  cap_.bind();
  glDrawElements(GL_TRIANGLES, capIndices_, GL_UNSIGNED_INT, nullptr);
}

void ObjectPainter::drawWires(const Scene& scene, const Paint& paint, double pixelsPerUnit) {
  const auto count = GLsizei(drawnLinks_.ends.size());
  if (count == 0) {
    return;
  }
  positions_.bind();
  const bool byValues = linksByValues(mesh_.get(), paint);
  if (byValues) {
    useValues(scene, paint, Shading::plain, paint.values->ofLinks);
    program_->setUniformValue("neutral", neutralColour(*mesh_, pixelsPerUnit));
  } else {
    use(scene, linkColour(*mesh_, paint, pixelsPerUnit), Shading::plain, mesh_->space_dimension);
  }
  useRest(paint.options);
  drawLines(scene, links_, count, byValues ? linkWidth(*mesh_, paint, pixelsPerUnit) : 1);
  if (thickensLinks(mesh_.get(), paint)) {
    drawThickLinks(scene, paint, pixelsPerUnit);
  }
}

/// Draws the links whose values are not neutral again: thicker, and on a surface a little nearer to the eye.
void ObjectPainter::drawThickLinks(const Scene& scene, const Paint& paint, double pixelsPerUnit) {
  useValues(scene, paint, Shading::plain, true);
  if (thickIndices_ == 0) {
    return;
  }
  if (isSolid(*mesh_, paint.options)) {
    program_->setUniformValue("to_clip", liftedClip(scene, thickLift));
  }
  program_->setUniformValue("first_value", int(drawnLinks_.numbers.size()));
  useRest(paint.options);
  drawLines(scene, thickLinks_, thickIndices_, thickWidth(*mesh_, pixelsPerUnit));
}

/// Draws links with the program in use; smooth and `width` logical pixels wide, unless there are very many.
void ObjectPainter::drawLines(const Scene& scene, QOpenGLBuffer& ends, GLsizei count, float width) {
  ends.bind();
  if (count <= maxIndicesSmoothed) {
    glLineWidth(width * scene.linkScale * scene.pixelRatio);
    glEnable(GL_LINE_SMOOTH);
  } else if (scene.linkScale > 1) {
    glLineWidth(scene.linkScale * scene.pixelRatio);
  }
  glDrawElements(GL_LINES, count, GL_UNSIGNED_INT, nullptr);
  glDisable(GL_LINE_SMOOTH);
  glLineWidth(1);
}

void ObjectPainter::drawEveryElement(const Scene& scene, const Paint& paint) {
  const bool byValues = valuesFit(paint);
  positions_.bind();
  if (byValues && !paint.values->ofLinks) {
    useValues(scene, paint, Shading::disc, false);
  } else {
    use(scene, byValues ? QColor(colour_map::neutral) : colours::stronger(paint.colour), Shading::disc,
        mesh_->space_dimension);
  }
  useRest(paint.options);
  program_->setUniformValue("point_size", elementSize * scene.pixelRatio);
  glDrawArrays(GL_POINTS, 0, GLsizei(mesh_->element_count()));
}

// Marks over the object: elements, links, strokes, text

/// Calls `draw` with the colour of marks. Behind the object, marks are drawn faintly first.
void ObjectPainter::drawMarked(const Scene& scene, QColor colour, const std::function<void(QColor)>& draw) {
  if (scene.hidesMarks) {
    QColor faint = colour;
    faint.setAlphaF(hiddenOpacity * colour.alphaF());
    glDisable(GL_DEPTH_TEST);
    draw(faint);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_FALSE);
  } else {
    glDisable(GL_DEPTH_TEST);
  }
  draw(colour);
  glDepthMask(GL_TRUE);
  glDisable(GL_DEPTH_TEST);
  vertexArray_.release();
}

void ObjectPainter::drawElements(const Scene& scene, std::span<const ElementId> elements, QColor colour, float diameter,
                                 Mark mark) {
  std::vector<float> positions;
  for (const ElementId e : elements) {
    const float* at = frame_->positions.data() + std::size_t{e} * mesh_->space_dimension;
    positions.insert(positions.end(), at, at + mesh_->space_dimension);
  }
  drawOwn(scene, positions, GL_POINTS, colour, shadingOf(mark), diameter);
}

void ObjectPainter::setSelection(const std::vector<ElementId>& elements) {
  selectedIndices_ = upload(selected_, thinned(elements, maxRingsPainted));
}

void ObjectPainter::drawSelection(const Scene& scene, QColor colour, float diameter) {
  if (selectedIndices_ == 0) {
    return;
  }
  const bool small = diameter < smallestRing;
  drawMarked(scene, colour, [&](QColor shade) {
    positions_.bind();
    use(overObject(scene), shade, small ? Shading::disc : Shading::ring, mesh_->space_dimension);
    program_->setUniformValue("point_size", diameter * scene.pixelRatio);
    selected_.bind();
    glDrawElements(GL_POINTS, selectedIndices_, GL_UNSIGNED_INT, nullptr);
  });
}

void ObjectPainter::drawLinks(const Scene& scene, std::span<const LinkId> links, QColor colour) {
  std::vector<float> positions;
  for (const LinkId link : links) {
    for (const ElementId e : mesh_->links[link]) {
      const float* at = frame_->positions.data() + std::size_t{e} * mesh_->space_dimension;
      positions.insert(positions.end(), at, at + mesh_->space_dimension);
    }
  }
  glLineWidth(litWidth * scene.linkScale * scene.pixelRatio);
  drawOwn(scene, positions, GL_LINES, colour, Shading::plain, 1);
  glLineWidth(1);
}

/// Draws marks at positions that are not in the object's buffer.
void ObjectPainter::drawOwn(const Scene& scene, std::span<const float> positions, GLenum mode, QColor colour,
                            Shading shading, float diameter) {
  if (positions.empty()) {
    return;
  }
  scratch_.bind();
  scratch_.allocate(positions.data(), int(positions.size_bytes()));
  drawMarked(scene, colour, [&](QColor shade) {
    scratch_.bind();
    use(overObject(scene), shade, shading, mesh_->space_dimension);
    program_->setUniformValue("point_size", diameter * scene.pixelRatio);
    glDrawArrays(mode, 0, GLsizei(positions.size() / mesh_->space_dimension));
  });
}

void ObjectPainter::drawStroke(const Scene& scene, std::span<const QPointF> positions, QColor colour) {
  if (positions.size() < 2) {
    return;
  }
  std::vector<float> device;
  for (const QPointF& at : positions) {
    device.push_back(float(2 * at.x() * scene.pixelRatio / scene.size.width() - 1));
    device.push_back(float(1 - 2 * at.y() * scene.pixelRatio / scene.size.height()));
  }
  glDisable(GL_DEPTH_TEST);
  scratch_.bind();
  scratch_.allocate(device.data(), int(device.size() * sizeof(float)));
  use(scene, colour, Shading::plain, 2);
  program_->setUniformValue("to_view", QMatrix4x4());
  program_->setUniformValue("to_clip", QMatrix4x4());
  glLineWidth(scene.pixelRatio);
  glDrawArrays(GL_LINE_STRIP, 0, GLsizei(positions.size()));
  glLineWidth(1);
  vertexArray_.release();
}

void ObjectPainter::paintOver(const Scene& scene, const std::function<void(QPainter&)>& draw) {
  QOpenGLPaintDevice device(scene.size.toSize());
  device.setDevicePixelRatio(double(scene.pixelRatio));
  QPainter painter(&device);
  draw(painter);
}

// Shapes of overlays, given by positions in space

void ObjectPainter::drawInSpace(const Scene& scene, std::span<const QVector3D> positions, Shape shape, QColor colour,
                                float width) {
  if (positions.empty()) {
    return;
  }
  glDisable(GL_DEPTH_TEST);
  scratch_.bind();
  scratch_.allocate(positions.data(), int(positions.size_bytes()));
  Scene over = scene;
  over.fog = {};
  use(over, colour, Shading::plain, 3);
  program_->setUniformValue("to_view", scene.toView);
  const bool lines = shape == Shape::segments;
  if (lines) {
    glLineWidth(width * scene.linkScale * scene.pixelRatio);
    glEnable(GL_LINE_SMOOTH);
  }
  glDrawArrays(lines ? GL_LINES : GL_TRIANGLES, 0, GLsizei(positions.size()));
  glDisable(GL_LINE_SMOOTH);
  glLineWidth(1);
  vertexArray_.release();
}

void ObjectPainter::drawValued(const Scene& scene, std::span<const QVector3D> positions, std::span<const float> values,
                               const ColourScale& scale, Shape shape, float width) {
  if (positions.empty()) {
    return;
  }
  const bool lines = shape == Shape::segments;
  if (mesh_->space_dimension == 3) {
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
  }
  scratch_.bind();
  scratch_.allocate(int(positions.size_bytes() + values.size_bytes()));
  scratch_.write(0, positions.data(), int(positions.size_bytes()));
  scratch_.write(int(positions.size_bytes()), values.data(), int(values.size_bytes()));
  Scene over = scene;
  over.fog = {};  // fading would change the colour, which is a value
  use(over, {}, lines ? Shading::plain : shape == Shape::discs ? Shading::disc : Shading::ring, 3, Colouring::elements);
  program_->setUniformValue("to_view", scene.toView);
  program_->setUniformValue("to_clip", liftedClip(scene, valuedLift));
  useMap(scale, colour_map::neutral);
  program_->enableAttributeArray(1);
  program_->setAttributeBuffer(1, GL_FLOAT, int(positions.size_bytes()), 1);
  program_->setUniformValue("point_size", width * scene.pixelRatio);
  glLineWidth(lines ? width * scene.linkScale * scene.pixelRatio : 1);
  glDrawArrays(lines ? GL_LINES : GL_POINTS, 0, GLsizei(positions.size()));
  glLineWidth(1);
  glDisable(GL_DEPTH_TEST);
  vertexArray_.release();
}

}  // namespace chainmail
