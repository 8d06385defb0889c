#include "tools/propagation_overlay.h"

#include <QLocale>
#include <QVector3D>
#include <algorithm>
#include <cmath>
#include <vector>

#include "drawing/colour_map.h"

namespace chainmail {
namespace {

// More steps would hide each other and take time. In a longer pass, only every n-th step is drawn.
constexpr std::size_t stepsDrawn = 10'000;
constexpr std::size_t waitingDrawn = 2'000;
constexpr float arrowWidth = 1.8F, currentWidth = 3.5F;  // pixels
constexpr double shareOfLink = 0.42, smallestDisc = 3, largestDisc = 13;
constexpr float currentRing = 11, grabbedSize = 13;  // pixels; the ring is that much larger than a disc
constexpr float headPixels = 8;
constexpr float headWidth = 0.45F;    // fraction of the head length, to either side
constexpr float largestHead = 0.35F;  // fraction of the arrow length
constexpr float smallestArrow = 2;    // pixels between the gaps; shorter arrows have no gaps

/// Returns n if every n-th step is drawn.
std::size_t drawnEvery(const PassPlayer& player) { return 1 + player.step() / (stepsDrawn + 1); }

float discSize(const Overlay::Canvas& canvas) {
  return float(
      std::clamp(shareOfLink * canvas.frame.mesh->mean_link_length / canvas.unitsPerPixel, smallestDisc, largestDisc));
}

/// Returns the position of an element in the space of the frame.
QVector3D elementPosition(const Frame& frame, ElementId element) {
  return asVector(frame.space.into(point_of(*frame.mesh, frame.view(), element)));
}

/// Returns the length of a logical pixel in the space of the frame.
double pixelIn(const Overlay::Canvas& canvas) { return canvas.unitsPerPixel / canvas.frame.space.unit(); }

/// Arrows from sponsors to the elements that they have updated, as pairs of ends. An arrow to an element that did not
/// move has no head.
class SponsorArrows {
 public:
  /// `gap` is the diameter of the free space around each element (logical pixels).
  SponsorArrows(const Overlay::Canvas& canvas, float gap)
      : frame_(canvas.frame),
        toEye_(canvas.scene.toView.row(2).toVector3D().normalized()),
        gap_(gap / 2 * float(pixelIn(canvas))),
        head_(headPixels * float(pixelIn(canvas))) {}

  /// Adds the arrow of a step, if it has a sponsor. The value of the arrow is the step.
  void add(const TraceRow& row, std::size_t step) {
    if (row.sponsor == no_element) {
      return;
    }
    QVector3D from = elementPosition(frame_, row.sponsor), to = elementPosition(frame_, row.element);
    const float length = (to - from).length();
    const QVector3D along = (to - from).normalized();
    if (length > 2 * gap_ + smallestArrow * head_ / headPixels) {
      from += along * gap_;
      to -= along * gap_;
    }
    add(from, to, step);
    if (row.moved) {
      const float head = std::min(head_, largestHead * (to - from).length());
      const QVector3D aside = QVector3D::crossProduct(along, toEye_).normalized() * (headWidth * head);
      add(to - along * head + aside, to, step);
      add(to - along * head - aside, to, step);
    }
  }

  const std::vector<QVector3D>& ends() const { return ends_; }
  const std::vector<float>& values() const { return values_; }

 private:
  void add(const QVector3D& from, const QVector3D& to, std::size_t step) {
    ends_.insert(ends_.end(), {from, to});
    values_.insert(values_.end(), 2, float(step));
  }

  const Frame& frame_;
  QVector3D toEye_;
  float gap_, head_;  // in the space of the frame
  std::vector<QVector3D> ends_;
  std::vector<float> values_;
};

}  // namespace

const PassPlayer* PropagationOverlay::player(int panel) const {
  return propagation_.isShown() ? propagation_.player(panel) : nullptr;
}

std::optional<ObjectDrawing::Paint> PropagationOverlay::paint(int panel) const {
  if (player(panel) == nullptr) {
    return std::nullopt;
  }
  return ObjectDrawing::Paint{QColor(colour_map::neutral), nullptr, {}};
}

ColourScale PropagationOverlay::scale() const {
  ColourScale scale;
  scale.lowest = 1;
  scale.highest = float(std::max<std::size_t>(1, propagation_.stepCount()));
  return scale;
}

std::optional<OverlayLegend> PropagationOverlay::legend(int panel) const {
  if (player(panel) == nullptr) {
    return std::nullopt;
  }
  return OverlayLegend{QStringLiteral("Order of update (candidate of the pass)"), scale(),
                       QStringLiteral("One scale for all panels: a colour means the same candidate number in each")};
}

QString PropagationOverlay::note(int panel) const {
  const PassPlayer* player = this->player(panel);
  if (player == nullptr) {
    return {};
  }
  const QLocale locale;
  QString note = QStringLiteral("pass %1").arg(locale.toString(qulonglong(player->pass().in_drag)));
  if (!propagation_.showsNewest()) {
    note += QStringLiteral(", candidate %1 of %2")
                .arg(locale.toString(qulonglong(player->step())), locale.toString(qulonglong(player->stepCount())));
  }
  if (const std::size_t every = drawnEvery(*player); every > 1) {
    note += QStringLiteral(", 1 of %1 candidates drawn").arg(every);
  }
  return note;
}

bool PropagationOverlay::isInMidPass(int panel) const {
  const PassPlayer* player = this->player(panel);
  return player != nullptr && !propagation_.showsNewest() && player->step() < player->stepCount();
}

void PropagationOverlay::draw(const Canvas& canvas) {
  const PassPlayer* player = this->player(canvas.panel);
  if (player == nullptr || player->pass().mesh != canvas.frame.mesh) {
    return;
  }
  if (arrows_) {
    drawArrows(canvas, *player);
  }
  drawElements(canvas, *player);
  drawFront(canvas, *player);
}

void PropagationOverlay::drawArrows(const Canvas& canvas, const PassPlayer& player) const {
  SponsorArrows arrows(canvas, discSize(canvas));
  for (std::size_t row = 0; row < player.step(); row += drawnEvery(player)) {
    arrows.add(player.pass().trace[row], row + 1);
  }
  canvas.painter.drawValued(canvas.scene, arrows.ends(), arrows.values(), scale(), ObjectDrawing::Shape::segments,
                            arrowWidth);
}

/// Draws elements that moved as discs, and the others as rings.
void PropagationOverlay::drawElements(const Canvas& canvas, const PassPlayer& player) const {
  for (const bool moved : {false, true}) {
    std::vector<QVector3D> positions;
    std::vector<float> values;
    for (std::size_t row = 0; row < player.step(); row += drawnEvery(player)) {
      if (player.pass().trace[row].moved == moved) {
        positions.push_back(elementPosition(canvas.frame, player.pass().trace[row].element));
        values.push_back(float(row + 1));
      }
    }
    canvas.painter.drawValued(canvas.scene, positions, values, scale(),
                              moved ? ObjectDrawing::Shape::discs : ObjectDrawing::Shape::rings, discSize(canvas));
  }
}

/// Draws the handle, the waiting list, and the last candidate.
void PropagationOverlay::drawFront(const Canvas& canvas, const PassPlayer& player) const {
  const auto mark = [&](std::span<const ElementId> elements, QColor colour, float size, ObjectDrawing::Mark shape) {
    canvas.painter.drawElements(canvas.scene, elements, colour, size, shape);
  };
  const float disc = discSize(canvas);
  mark(player.pass().handle, colours::lit, grabbedSize, ObjectDrawing::Mark::disc);
  if (propagation_.showsNewest()) {
    return;
  }
  std::vector<ElementId> waiting;
  for (const std::uint32_t i : player.history().at(player.step())) {
    const ElementId element = player.history().candidates()[i].element;
    if (player.updatedAt(element) > player.step() && waiting.size() < waitingDrawn) {
      waiting.push_back(element);
    }
  }
  mark(waiting, colours::marked, disc, ObjectDrawing::Mark::ring);
  if (player.step() > 0) {
    const TraceRow& current = player.pass().trace[player.step() - 1];
    mark(std::span(&current.element, 1), colours::marked, disc + currentRing, ObjectDrawing::Mark::ring);
    SponsorArrows arrow(canvas, disc);
    arrow.add(current, player.step());
    canvas.painter.drawInSpace(canvas.scene, arrow.ends(), ObjectDrawing::Shape::segments, colours::marked,
                               currentWidth);
  }
}

}  // namespace chainmail
