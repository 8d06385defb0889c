#include "tools/rotation_ring.h"

#include <QLineF>
#include <QLocale>
#include <QVector3D>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "common/colours.h"
#include "document/element_facts.h"
#include "panels/view.h"

namespace chainmail {
namespace {

constexpr double smallestRing = 40, ringMargin = 16;  // pixels, radius and distance from the elements
constexpr double largestRingShare = 0.45;             // of the smaller side of the view
constexpr double ringReach = 6;                       // pixels, distance at which the cursor finds the ring
constexpr float ringWidth = 2, litRingWidth = 3;      // pixels
constexpr float ringRim = 2;                          // pixels of background, both sides together
constexpr double largestSagitta = 0.25;               // pixels between the circle and its chords
constexpr double ringOverlap = 0.5;                   // pixels; smooth lines are faint at their ends
constexpr double measuredPixels = 100;

}  // namespace

RotationRing::RotationRing(const Document& document) : document_(document) {
  connect(&document.selection(), &Selection::changed, this, &RotationRing::followSelection);
  for (const auto signal : {&Document::pinsChanged, &Document::meshChanged}) {
    connect(&document, signal, this, &RotationRing::followSelection);
  }
  connect(&document, &Document::meshChanged, this, &RotationRing::hideRotation);
}

void RotationRing::followSelection() {
  elements_.clear();
  extents_.fill({});
  if (active_ && canRotate(*document_.mesh())) {
    std::ranges::set_difference(document_.selection().elements(), document_.pins(), std::back_inserter(elements_));
  }
  if (elements_.size() < 2) {
    elements_.clear();
  }
  emit changed();
}

void RotationRing::setActive(bool active) {
  active_ = active;
  followSelection();
}

void RotationRing::setHovered(bool hovered) {
  if (hovered != hovered_) {
    hovered_ = hovered;
    emit changed();
  }
}

void RotationRing::showRotation(const std::vector<ElementId>& handle, int panel, QPointF cursor, double degrees) {
  if (!turn_ || turn_->handle != handle) {
    extents_.fill({});
  }
  turn_ = Turn{handle, panel, cursor, degrees};
  emit changed();
}

void RotationRing::hideRotation() {
  if (turn_) {
    turn_.reset();
    extents_.fill({});
    emit changed();
  }
}

/// Returns the extent of the elements, which may be many: it is computed once per frame.
const RotationExtent& RotationRing::extent(const View& view) const {
  auto& kept = extents_[std::size_t(view.panel())];
  const Frame* frame = document_.solvers().frame(view.panel());
  const std::uint64_t number = frame == nullptr ? 0 : frame->number, series = frame == nullptr ? 0 : frame->series;
  if (!kept || kept->frame != number || kept->series != series) {
    kept.emplace();
    kept->frame = number;
    kept->series = series;
    kept->pivot = middleIn(document_, view.panel(), rotated());
    for (const ElementId element : rotated()) {
      kept->reach = std::max(kept->reach, (view.position(element) - kept->pivot).norm());
    }
  }
  return *kept;
}

/// Returns the ring in a view. It encloses the elements from every side, so that its size does not change while they
/// rotate. A large ring is limited, so that it stays within reach of the cursor.
std::optional<RotationRing::Circle> RotationRing::circle(const View& view) const {
  if (rotated().empty()) {
    return std::nullopt;
  }
  const RotationExtent& extent = this->extent(view);
  Circle circle;
  circle.pivot = extent.pivot;
  const Point across =
      view.pointAt({measuredPixels, 0}, circle.pivot) - view.pointAt({0, 0}, circle.pivot);  // parallel to the view
  circle.unitsPerPixel = across.norm() / measuredPixels;
  const double largest = std::max(smallestRing, largestRingShare * std::min(view.width(), view.height()));
  circle.radius = std::clamp(extent.reach / circle.unitsPerPixel + ringMargin, smallestRing, largest);
  return circle;
}

bool RotationRing::isAt(const View& view, QPointF position) const {
  const auto ring = circle(view);
  return ring && std::abs(QLineF(view.viewPosition(ring->pivot), position).length() - ring->radius) <= ringReach;
}

void RotationRing::draw(const Canvas& canvas) {
  const auto ring = circle(canvas.view);
  if (!ring) {
    return;
  }
  const FrameSpace& space = canvas.frame.space;
  const auto radius = float(ring->radius * ring->unitsPerPixel / space.unit());
  const QVector3D right = canvas.scene.toView.row(0).toVector3D().normalized() * radius;
  const QVector3D up = canvas.scene.toView.row(1).toVector3D().normalized() * radius;
  const auto at = [&](double angle) {
    return asVector(space.into(ring->pivot)) + right * float(std::cos(angle)) + up * float(std::sin(angle));
  };
  const int corners = int(std::ceil(M_PI / std::acos(1 - largestSagitta / ring->radius)));
  const double overlap = ringOverlap / ring->radius;
  std::vector<QVector3D> ends;
  for (int i = 0; i < corners; ++i) {
    ends.push_back(at(2 * M_PI * i / corners - overlap));
    ends.push_back(at(2 * M_PI * (i + 1) / corners + overlap));
  }
  const bool lit = hovered_ || turn_;
  const float width = lit ? litRingWidth : ringWidth;
  const auto draw = [&](QColor colour, float pixels) {
    canvas.painter.drawInSpace(canvas.scene, ends, ObjectDrawing::Shape::segments, colour, pixels);
  };
  draw(canvas.scene.background, width + ringRim);
  draw(turn_ ? colours::lit : hovered_ ? colours::marked : colours::selected, width);
}

std::vector<Annotation> RotationRing::annotations(const View& view) const {
  if (!turn_ || turn_->panel != view.panel()) {
    return {};
  }
  const QPointF pivot = view.viewPosition(extent(view).pivot);
  const long degrees = std::lround(turn_->degrees);
  const QString sign = degrees < 0 ? QStringLiteral("−") : QString();
  return {{QLineF(pivot, turn_->cursor), QStringLiteral("%1%2°").arg(sign, QLocale().toString(std::abs(degrees)))}};
}

}  // namespace chainmail
