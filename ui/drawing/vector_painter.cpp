#include "drawing/vector_painter.h"

#include <algorithm>
#include <cmath>

#include "common/colours.h"
#include "drawing/colour_map.h"
#include "drawing/projection.h"

namespace chainmail {
namespace {

// As the screen's: what fades with depth never fades whole.
constexpr float mostFaded = 0.75F;
// Of a link's length: lines and marks of a surface lie before its faces.
constexpr float liftOfLines = 0.5F;
constexpr float ringHole = 0.64F;  // of its diameter
constexpr double soft = 0.5;       // pixels: the screen's marks fade inside their edges
constexpr int shadesOfALink = 8;   // at most, where its ends differ in value

}  // namespace

VectorPainter::VectorPainter(QPainter& painter, std::shared_ptr<MeshLevels> levels)
    : painter_(painter), parts_(std::move(levels)) {
  painter_.setRenderHint(QPainter::Antialiasing);
}

VectorPainter::~VectorPainter() { flush(); }

void VectorPainter::setFrame(const Frame& frame, const Cuts& cuts) {
  frame_ = &frame;
  parts_.setFrame(frame, cuts);
  placement_ = placement(*frame.mesh);
}

QVector3D VectorPainter::inSpace(ElementId element) const {
  std::array<float, 3> carried{};
  const int dimension = frame_->mesh->space_dimension;
  std::copy_n(frame_->positions.data() + std::size_t{element} * dimension, dimension, carried.begin());
  return placement_.map(QVector3D(carried[0], carried[1], carried[2]));
}

VectorPainter::Seen VectorPainter::seen(const Scene& scene, const QVector3D& place) {
  const QVector4D inView = scene.toView * QVector4D(place, 1), clip = scene.toClip * inView;
  const QSizeF size = scene.logicalSize();
  return {{(1 + double(clip.x() / clip.w())) / 2 * size.width(), (1 - double(clip.y() / clip.w())) / 2 * size.height()},
          -inView.z(),
          clip.w() > 0};
}

QColor VectorPainter::faded(const Scene& scene, const QColor& colour, float distance) {
  if (!(scene.fog.y() > scene.fog.x())) {
    return colour;
  }
  const float fade = mostFaded * std::clamp((distance - scene.fog.x()) / (scene.fog.y() - scene.fog.x()), 0.0F, 1.0F);
  const auto mixed = [fade](float of, float with) { return of + fade * (with - of); };
  const QColor& ground = scene.background;
  return QColor::fromRgbF(mixed(colour.redF(), ground.redF()), mixed(colour.greenF(), ground.greenF()),
                          mixed(colour.blueF(), ground.blueF()), colour.alphaF());
}

/// Nothing of what is behind the eye or out of the view: not all that hold drawings can clip.
void VectorPainter::add(const Scene& scene, std::span<const QVector3D> places, const QColor& colour, float width,
                        Mark mark, float lift) {
  Piece piece{{}, int(places.size()), -lift, colour, width, mark};
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Seen corner = seen(scene, places[i]);
    if (!corner.before) {
      return;
    }
    piece.corners[i] = corner.at;
    piece.distance += corner.distance / float(places.size());
  }
  piece.colour = faded(scene, colour, piece.distance + lift);
  const QRectF view(QPointF(), scene.logicalSize());
  const auto corners = std::span(piece.corners).first(places.size());
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
  double first = 0, last = 1;                         // the share of the line that is in the view
  const auto keep = [&](double along, double room) {  // along * share <= room
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

void VectorPainter::drawObject(const Scene& scene, const Paint& wanted, double pixelsPerUnit) {
  parts_.choose(scene, wanted, pixelsPerUnit);
  Paint paint = wanted;
  paint.look.links = paint.look.links && !parts_.leavesLinksOut();
  addFaces(scene, paint);
  addCap(scene, paint);
  addLinks(scene, paint);
  if (paint.look.links && parts_.step() == 1 && marksElements(*frame_->mesh, pixelsPerUnit)) {
    addElements(scene, paint);
  }
}

void VectorPainter::addLinks(const Scene& scene, const Paint& paint) {
  const Mesh& mesh = *frame_->mesh;
  const bool byValues = valuesFit(&mesh, paint);
  const DrawnLinks links = parts_.links();
  const auto values =
      byValues && paint.values->ofLinks ? parts_.valuesOf(links.numbers, *paint.values) : std::vector<float>();
  for (std::size_t i = 0; i < links.numbers.size(); ++i) {
    const ElementId a = links.ends[2 * i], b = links.ends[2 * i + 1];
    const auto [first, last] = shown(a, b, paint.look);
    if (!(first < last)) {
      continue;
    }
    const auto along = [&](float share) { return inSpace(a) + share * (inSpace(b) - inSpace(a)); };
    const std::array ends{along(first), along(last)};
    if (!byValues) {
      add(scene, ends, paint.colour, 1, Mark::disc, liftOfLines * float(mesh.mean_link_length));
    } else if (paint.values->ofLinks) {
      addLink(scene, ends, {values[i], values[i]}, paint.scale, valuedWidth);
    } else {
      const float from = paint.values->values[a], to = paint.values->values[b];
      addLink(scene, ends, {std::lerp(from, to, first), std::lerp(from, to, last)}, paint.scale, valuedWidth);
    }
  }
}

/// In as many pieces as its ends differ in colour.
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
    if (beforeSection(element, paint.look) > 0) {
      continue;
    }
    const QVector3D place = inSpace(element);
    add(scene, std::span(&place, 1), ofElements ? colour_map::of(paint.values->values[element], paint.scale) : colour,
        elementSize, Mark::disc, 2 * liftOfLines * float(mesh.mean_link_length));
  }
}

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
  } else if (const double radius = double(piece.width) / 2 - soft; piece.mark == Mark::diamond) {
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
