// The order of this file: frames, pieces, the object, marks and shapes over it, output.

#include "drawing/vector_painter.h"

#include <algorithm>
#include <cmath>

#include "common/colours.h"
#include "drawing/colour_map.h"
#include "drawing/drawn_parts.h"
#include "drawing/projection.h"

namespace chainmail {
namespace {

constexpr float liftOfLines = 0.5F;  // mean link lengths; draws links and marks of a surface in front of its faces
constexpr float ringHole = 0.64F;    // diameter of the hole, as a fraction of the ring's diameter
constexpr double softEdge = 0.5;     // pixels; on the screen, marks fade inside their edges
constexpr int shadesOfALink = 8;     // largest number, if the values at its ends differ
constexpr float seamWidth = 0.7F;    // pixels; closes the gaps between faces
// Faces whose smooth normal differs more than this from their own lie at a crease (cosine of the angle).
constexpr float printedCrease = 0.65F;
constexpr std::size_t maxRingsPrinted = 5'000;  // more rings would hide each other

/// Returns the mean colour of a few texels in a triangle. `corners` are its rest positions.
QColor texelsOf(const Texture& texture, const std::array<Point, 3>& corners) {
  std::array<int, 4> sum{};
  int count = 0;
  for (const auto& [a, b, c] : {std::array{2, 2, 2}, std::array{4, 1, 1}, std::array{1, 4, 1}, std::array{1, 1, 4}}) {
    const Point at = (a * corners[0] + b * corners[1] + c * corners[2]) / 6;
    std::size_t texel = 0;
    for (int k = 2; k >= 0; --k) {
      const double length = texture.box[1][k] - texture.box[0][k];
      const double share = length > 0 ? (at[k] - texture.box[0][k]) / length : 0;
      const double last = texture.size[k] - 1.0;
      texel = texel * texture.size[k] + std::size_t(std::clamp(std::floor(share * texture.size[k]), 0.0, last));
    }
    for (int channel = 0; channel < 4; ++channel) {
      const bool grey = texture.channels == 1;
      sum[channel] += grey && channel == 3 ? 255 : texture.texels[texel * texture.channels + (grey ? 0 : channel)];
    }
    ++count;
  }
  return {sum[0] / count, sum[1] / count, sum[2] / count, sum[3] / count};
}

ObjectDrawing::Scene withoutFog(ObjectDrawing::Scene scene) {
  scene.fog = {};
  return scene;
}

}  // namespace

// Frames

VectorPainter::VectorPainter(QPainter& painter, std::shared_ptr<MeshLevels> levels)
    : painter_(painter), parts_(std::move(levels)) {
  painter_.setRenderHint(QPainter::Antialiasing);
}

VectorPainter::~VectorPainter() { flush(); }

void VectorPainter::setFrame(const Frame& frame, const Cuts& cuts) {
  frame_ = &frame;
  parts_.setFrame(frame, cuts);
  meshToWorld_ = meshToWorld(*frame.mesh);
  frontSign_ = frame.mesh->space_dimension == 2 ? frontSign(*frame.mesh) : 0;
}

QVector3D VectorPainter::inSpace(ElementId element) const {
  std::array<float, 3> coordinates{};
  const int dimension = frame_->mesh->space_dimension;
  std::copy_n(frame_->positions.data() + std::size_t{element} * dimension, dimension, coordinates.begin());
  return meshToWorld_.map(QVector3D(coordinates[0], coordinates[1], coordinates[2]));
}

// Pieces: projected, faded and clipped marks, lines and faces

VectorPainter::Projected VectorPainter::projected(const Scene& scene, const QVector3D& position) {
  const QVector4D inView = scene.toView * QVector4D(position, 1), clip = scene.toClip * inView;
  const QSizeF size = scene.logicalSize();
  return {{(1 + double(clip.x() / clip.w())) / 2 * size.width(), (1 - double(clip.y() / clip.w())) / 2 * size.height()},
          -inView.z(),
          clip.w() > 0};
}

QColor VectorPainter::faded(const Scene& scene, const QColor& colour, float distance) const {
  if (!(scene.fog.y() > scene.fog.x())) {
    return colour;
  }
  const float fade = fade_ * std::clamp((distance - scene.fog.x()) / (scene.fog.y() - scene.fog.x()), 0.0F, 1.0F);
  const auto mixed = [fade](float of, float with) { return of + fade * (with - of); };
  const QColor& ground = scene.background;
  return QColor::fromRgbF(mixed(colour.redF(), ground.redF()), mixed(colour.greenF(), ground.greenF()),
                          mixed(colour.blueF(), ground.blueF()), colour.alphaF());
}

/// Adds a piece, without its parts outside the view, because some programs that show vector graphics cannot clip. Skips
/// a piece that is behind the eye.
void VectorPainter::add(const Scene& scene, std::span<const QVector3D> positions, const QColor& colour, float width,
                        Mark mark, float lift) {
  Piece piece{{}, int(positions.size()), -lift, colour, width, mark};
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Projected corner = projected(scene, positions[i]);
    if (!corner.before) {
      return;
    }
    piece.corners[i] = corner.at;
    piece.distance += corner.distance / float(positions.size());
  }
  piece.colour = faded(scene, colour, piece.distance + lift);
  const QRectF view(QPointF(), scene.logicalSize());
  const auto corners = std::span(piece.corners).first(positions.size());
  if (std::ranges::all_of(corners, [&](const QPointF& corner) { return view.contains(corner); })) {
    pieces_.push_back(piece);
  } else if (piece.count == 2) {
    addClipped(piece, view);
  } else if (piece.count == 3) {
    addFaceClipped(piece, view);
  }
}

void VectorPainter::addClipped(Piece piece, const QRectF& view) {
  const QPointF from = piece.corners[0], way = piece.corners[1] - from;
  double first = 0, last = 1;                         // the visible part of the line, as fractions of it
  const auto keep = [&](double along, double room) {  // clips to along * share <= room
    if (along > 0) {
      last = std::min(last, room / along);
    } else if (along < 0) {
      first = std::max(first, room / along);
    } else if (room < 0) {
      last = -1;
    }
  };
  keep(way.x(), view.right() - from.x());
  keep(-way.x(), from.x() - view.left());
  keep(way.y(), view.bottom() - from.y());
  keep(-way.y(), from.y() - view.top());
  if (first < last) {
    piece.corners[0] = from + first * way;
    piece.corners[1] = from + last * way;
    pieces_.push_back(piece);
  }
}

void VectorPainter::addFaceClipped(Piece piece, const QRectF& view) {
  const auto part = QPolygonF(QList<QPointF>(piece.corners.begin(), piece.corners.end())).intersected(view);
  for (qsizetype i = 2; i < part.size(); ++i) {
    piece.corners = {part[0], part[i - 1], part[i]};
    pieces_.push_back(piece);
  }
}

// The object: faces, section, links, elements

void VectorPainter::drawObject(const Scene& scene, const Paint& wanted, double pixelsPerUnit) {
  parts_.choose(scene, wanted, pixelsPerUnit);
  Paint paint = wanted;
  paint.options.links = paint.options.links && !parts_.leavesLinksOut();
  lighting_ = lighting(*frame_->mesh, paint);
  fade_ = fade(*frame_->mesh, paint);
  addFaces(scene, paint);
  addCap(scene);
  addLinks(scene, paint, pixelsPerUnit);
  if (paint.options.links && !isSolid(*frame_->mesh, paint.options) && parts_.step() == 1 &&
      marksElements(*frame_->mesh, pixelsPerUnit)) {
    addElements(scene, paint);
  }
}

double VectorPainter::beforeSection(ElementId element, const DrawOptions& options) const {
  return options.section ? options.section->before(frame_->mesh->rest_position(element)) : 0;
}

std::array<float, 2> VectorPainter::shown(ElementId from, ElementId to, const DrawOptions& options) const {
  const double first = beforeSection(from, options), last = beforeSection(to, options);
  const float meets = float(first / (first - last));
  return {first > 0 ? (last > 0 ? 1 : meets) : 0, last > 0 ? (first > 0 ? 0 : meets) : 1};
}

std::vector<QVector3D> VectorPainter::shown(std::span<const ElementId> corners, const DrawOptions& options) const {
  std::vector<QVector3D> positions;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const ElementId a = corners[i], b = corners[(i + 1) % corners.size()];
    const double before = beforeSection(a, options), next = beforeSection(b, options);
    if (!(before > 0)) {
      positions.push_back(inSpace(a));
    }
    if ((before > 0) != (next > 0)) {
      positions.push_back(inSpace(a) + float(before / (before - next)) * (inSpace(b) - inSpace(a)));
    }
  }
  return positions;
}

QColor VectorPainter::lit(const Scene& scene, std::span<const QVector3D> positions, std::span<const ElementId> corners,
                          const QColor& colour) const {
  const auto toViewer = [&](const QVector3D& normal) {
    const QVector3D seen = scene.toView.mapVector(normal).normalized();
    return seen.z() < 0 ? -seen : seen;
  };
  QVector3D normal = toViewer(QVector3D::normal(positions[0], positions[1], positions[2]));
  QVector3D smooth;
  for (const ElementId corner : corners) {
    smooth += normals_.normals()[corner].normalized();
  }
  if (const QVector3D seen = toViewer(smooth); QVector3D::dotProduct(seen, normal) > printedCrease) {
    normal = seen;
  }
  return lighting_.of(colour, normal);
}

/// Returns the colour of a face in a plane, which is darker if the face is folded.
QColor VectorPainter::folded(const Scene& scene, const Paint& paint, const std::array<QVector3D, 3>& corners,
                             QColor face) const {
  const QVector3D a = scene.toView.map(corners[0]), b = scene.toView.map(corners[1]), c = scene.toView.map(corners[2]);
  const float area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
  const QMatrix4x4 seen = scene.toView * meshToWorld_;
  const float sign = seen(0, 0) * seen(1, 1) < seen(0, 1) * seen(1, 0) ? -frontSign_ : frontSign_;
  if (area * sign < 0) {
    const float share = facesByValues(frame_->mesh.get(), paint) || showsPicture(*frame_->mesh) ? 0.75F : 0.55F;
    face = QColor::fromRgbF(share * face.redF(), share * face.greenF(), share * face.blueF(),
                            std::min(1.0F, face.alphaF() + 0.3F));
  }
  return face;
}

void VectorPainter::addFaces(const Scene& scene, const Paint& paint) {
  const Mesh& mesh = *frame_->mesh;
  const auto faces = parts_.faces(), fresh = parts_.freshFaces();
  if (isSolid(mesh, paint.options)) {
    auto all = faces;
    all.insert(all.end(), fresh.begin(), fresh.end());
    normals_.setFaces(std::move(all), mesh.element_count());
    normals_.follow(*frame_);
  }
  addFaces(scene, paint, faces, faceColour(mesh, paint));
  addFaces(scene, paint, fresh, colours::inner);
}

void VectorPainter::addFaces(const Scene& scene, const Paint& paint, std::span<const ElementId> corners,
                             const QColor& colour) {
  const Mesh& mesh = *frame_->mesh;
  const bool opaque = mesh.space_dimension == 3 || showsPicture(mesh) || facesByValues(&mesh, paint);
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    const auto elements = corners.subspan(i, 3);
    const auto positions = shown(elements, paint.options);
    for (std::size_t j = 2; j < positions.size(); ++j) {
      const std::array part{positions[0], positions[j - 1], positions[j]};
      add(scene, part, colourOf(scene, paint, elements, part, colour), opaque ? seamWidth : 0);
    }
  }
}

/// Returns the colour of a part of a face.
QColor VectorPainter::colourOf(const Scene& scene, const Paint& paint, std::span<const ElementId> corners,
                               const std::array<QVector3D, 3>& part, const QColor& colour) const {
  const Mesh& mesh = *frame_->mesh;
  QColor face = colour;
  if (showsPicture(mesh)) {
    face = texelsOf(*mesh.texture,
                    {mesh.rest_position(corners[0]), mesh.rest_position(corners[1]), mesh.rest_position(corners[2])});
  } else if (facesByValues(&mesh, paint)) {
    const auto& values = elementValues(*paint.values);
    face = colour_map::of((values[corners[0]] + values[corners[1]] + values[corners[2]]) / 3, paint.scale);
  }
  if (mesh.space_dimension < 3) {
    return folded(scene, paint, part, face);
  }
  return showsPicture(mesh) ? face : lit(scene, part, corners, face);
}

void VectorPainter::addCap(const Scene& scene) {
  const Section* section = parts_.section();
  if (section == nullptr) {
    return;
  }
  const Mesh& mesh = *frame_->mesh;
  const auto positions = positionsOf(*section, *frame_);
  const auto corners = section->triangles(parts_.surface());
  const auto rest = [&](std::uint32_t corner) -> Point {
    const SectionPoint& point = section->points()[corner];
    const Point from = mesh.rest_position(point.from);
    return from + double(point.share) * (mesh.rest_position(point.to) - from);
  };
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    const std::array part{positions[corners[i]], positions[corners[i + 1]], positions[corners[i + 2]]};
    const QColor face = showsSlices(mesh)
                            ? texelsOf(*mesh.texture, {rest(corners[i]), rest(corners[i + 1]), rest(corners[i + 2])})
                            : lit(scene, part, {}, colours::inner);
    add(scene, part, face, seamWidth);
  }
}

void VectorPainter::addLinks(const Scene& scene, const Paint& paint, double pixelsPerUnit) {
  const Mesh& mesh = *frame_->mesh;
  const bool byValues = linksByValues(&mesh, paint);
  const QColor colour = linkColour(mesh, paint, pixelsPerUnit);
  const DrawnLinks links = parts_.links();
  const bool ofLinks = valuesFit(&mesh, paint) && paint.values->ofLinks;
  const auto values = ofLinks ? parts_.valuesOf(links.numbers, *paint.values) : std::vector<float>();
  for (std::size_t i = 0; i < links.numbers.size(); ++i) {
    const ElementId a = links.ends[2 * i], b = links.ends[2 * i + 1];
    const auto [first, last] = shown(a, b, paint.options);
    if (!(first < last)) {
      continue;
    }
    const auto along = [&](float share) { return inSpace(a) + share * (inSpace(b) - inSpace(a)); };
    const std::array ends{along(first), along(last)};
    if (ofLinks && (byValues || !paint.scale.isNeutral(values[i]))) {
      addLinkOfValue(scene, ends, values[i], paint, pixelsPerUnit);
    } else if (!byValues) {
      add(scene, ends, colour, 1, Mark::disc, liftOfLines * float(mesh.mean_link_length));
    } else {
      const float from = paint.values->values[a], to = paint.values->values[b];
      addLink(scene, ends, {std::lerp(from, to, first), std::lerp(from, to, last)}, paint.scale, valuedWidth);
    }
  }
}

/// Adds a link with a value of its own. One that is not neutral is thicker and over the others: next to a surface only
/// over those that are equally far from the eye.
void VectorPainter::addLinkOfValue(const Scene& scene, const std::array<QVector3D, 2>& ends, float value,
                                   const Paint& paint, double pixelsPerUnit) {
  const Mesh& mesh = *frame_->mesh;
  const bool thickens = thickensLinks(&mesh, paint), thick = thickens && !paint.scale.isNeutral(value);
  const float near = liftOfLines * float(mesh.mean_link_length);
  const float over = isSolid(mesh, paint.options) ? 2 * near : near + scene.fog.y() - scene.fog.x();
  add(scene, ends,
      paint.scale.isNeutral(value) ? neutralColour(mesh, pixelsPerUnit) : colour_map::of(value, paint.scale),
      thick ? thickWidth(mesh, pixelsPerUnit) : linkWidth(mesh, paint, pixelsPerUnit), Mark::disc,
      thick ? over + near : near);
}

/// Adds a link in pieces of one colour each. Their number grows with the difference between the values at its ends.
void VectorPainter::addLink(const Scene& scene, const std::array<QVector3D, 2>& ends,
                            const std::array<float, 2>& values, const ColourScale& scale, float width) {
  const float range = scale.highest - scale.lowest;
  const float apart = range > 0 ? std::abs(values[1] - values[0]) / range : 0;
  const int pieces = std::clamp(int(std::ceil(apart * 2 * shadesOfALink)), 1, shadesOfALink);
  const float lift = liftOfLines * float(frame_->mesh->mean_link_length);
  for (int i = 0; i < pieces; ++i) {
    const auto along = [&](float share) { return ends[0] + share * (ends[1] - ends[0]); };
    const std::array part{along(float(i) / float(pieces)), along(float(i + 1) / float(pieces))};
    const float value = std::lerp(values[0], values[1], (float(i) + 0.5F) / float(pieces));
    add(scene, part, colour_map::of(value, scale), width, Mark::disc, lift);
  }
}

void VectorPainter::addElements(const Scene& scene, const Paint& paint) {
  const Mesh& mesh = *frame_->mesh;
  const bool byValues = valuesFit(&mesh, paint), ofElements = byValues && !paint.values->ofLinks;
  const QColor colour = byValues ? QColor(colour_map::neutral) : colours::stronger(paint.colour);
  for (ElementId element = 0; element < mesh.element_count(); ++element) {
    if (beforeSection(element, paint.options) > 0) {
      continue;
    }
    const QVector3D position = inSpace(element);
    add(scene, std::span(&position, 1),
        ofElements ? colour_map::of(paint.values->values[element], paint.scale) : colour, elementSize, Mark::disc,
        2 * liftOfLines * float(mesh.mean_link_length));
  }
}

// Marks and shapes over the object

void VectorPainter::drawElements(const Scene& scene, std::span<const ElementId> elements, QColor colour, float diameter,
                                 Mark mark) {
  flush();
  for (const ElementId element : elements) {
    const QVector3D position = inSpace(element);
    add(withoutFog(scene), std::span(&position, 1), colour, diameter, mark);
  }
  flush();
}

void VectorPainter::drawSelection(const Scene& scene, QColor colour, float diameter) {
  drawElements(scene, thinned(selected_, maxRingsPrinted), colour, diameter,
               diameter < smallestRing ? Mark::disc : Mark::ring);
}

void VectorPainter::drawLinks(const Scene& scene, std::span<const LinkId> links, QColor colour) {
  std::vector<QVector3D> positions;
  for (const LinkId link : links) {
    for (const ElementId e : frame_->mesh->links[link]) {
      positions.push_back(inSpace(e));
    }
  }
  drawInSpace(scene, positions, Shape::segments, colour, litWidth);
}

void VectorPainter::drawStroke(const Scene& /*scene*/, std::span<const QPointF> positions, QColor colour) {
  flush();
  painter_.setPen(QPen(colour, 1));
  painter_.setBrush(Qt::NoBrush);
  painter_.drawPolyline(positions.data(), int(positions.size()));
}

void VectorPainter::drawInSpace(const Scene& scene, std::span<const QVector3D> positions, Shape shape, QColor colour,
                                float width) {
  flush();
  const std::size_t corners = shape == Shape::segments ? 2 : 3;
  for (std::size_t i = 0; i + corners <= positions.size(); i += corners) {
    add(withoutFog(scene), positions.subspan(i, corners), colour, corners == 2 ? width : 0);
  }
  flush();
}

void VectorPainter::drawValued(const Scene& scene, std::span<const QVector3D> positions, std::span<const float> values,
                               const ColourScale& scale, Shape shape, float width) {
  const auto in = withoutFog(scene);
  const float lift = 2 * float(frame_->mesh->mean_link_length);
  const bool lines = shape == Shape::segments;
  for (std::size_t i = 0, step = lines ? 2 : 1; i + step <= positions.size(); i += step) {
    const float value = lines ? (values[i] + values[i + 1]) / 2 : values[i];
    add(in, positions.subspan(i, step), colour_map::of(value, scale), width,
        shape == Shape::rings ? Mark::ring : Mark::disc, lift);
  }
}

void VectorPainter::paintOver(const Scene& /*scene*/, const std::function<void(QPainter&)>& draw) {
  flush();
  draw(painter_);
}

void VectorPainter::drawSeeThrough(const Scene& /*scene*/, double opacity, const std::function<void()>& draw) {
  if (opacity > 0) {
    flush();
    painter_.setOpacity(std::min(opacity, 1.0));
    draw();
    flush();
    painter_.setOpacity(1);
  }
}

// Output

void VectorPainter::flush() {
  std::ranges::stable_sort(pieces_, std::greater(), &Piece::distance);
  for (const Piece& piece : pieces_) {
    draw(piece);
  }
  pieces_.clear();
}

void VectorPainter::draw(const Piece& piece) {
  painter_.setBrush(piece.count == 2 ? Qt::NoBrush : QBrush(piece.colour));
  painter_.setPen(Qt::NoPen);
  if (piece.count == 2) {
    painter_.setPen(QPen(piece.colour, piece.width, Qt::SolidLine, Qt::FlatCap));
    painter_.drawLine(piece.corners[0], piece.corners[1]);
  } else if (piece.count == 3) {
    if (piece.width > 0) {
      painter_.setPen(QPen(piece.colour, piece.width, Qt::SolidLine, Qt::FlatCap, Qt::RoundJoin));
    }
    painter_.drawConvexPolygon(piece.corners.data(), piece.count);
  } else if (const double radius = double(piece.width) / 2 - softEdge; piece.mark == Mark::diamond) {
    const std::array<QPointF, 4> round{QPointF(0, -radius), {radius, 0}, {0, radius}, {-radius, 0}};
    painter_.drawConvexPolygon(QPolygonF(QList<QPointF>(round.begin(), round.end())).translated(piece.corners[0]));
  } else if (piece.mark == Mark::ring) {
    const double line = radius * (1 - ringHole);
    painter_.setBrush(Qt::NoBrush);
    painter_.setPen(QPen(piece.colour, line));
    painter_.drawEllipse(piece.corners[0], radius - line / 2, radius - line / 2);
  } else {
    painter_.drawEllipse(piece.corners[0], radius, radius);
  }
}

}  // namespace chainmail
