#include "tools/propagation_overlay.h"

#include <QLocale>
#include <algorithm>
#include <cmath>

#include "drawing/colour_map.h"
#include "tools/sponsor_arrows.h"

namespace chainmail {
namespace {

// More hide each other, and cost time: of more, evenly some are drawn.
constexpr std::size_t stepsDrawn = 10'000;
constexpr std::size_t waitingDrawn = 2'000;
constexpr float arrowWidth = 1.8F, currentWidth = 3.5F;  // pixels
constexpr double shareOfLink = 0.42, smallestDisc = 3, largestDisc = 13;
constexpr float currentRing = 11, grabbedSize = 13;  // pixels more than a disc; pixels

/// Every how manieth step is drawn.
std::size_t stride(const PassPlayer& player) { return 1 + player.step() / (stepsDrawn + 1); }

float discSize(const Overlay::Canvas& canvas) {
  return float(
      std::clamp(shareOfLink * canvas.frame.mesh->mean_link_length / canvas.unitsPerPixel, smallestDisc, largestDisc));
}

}  // namespace

const PassPlayer* PropagationOverlay::player(int panel) const {
  return propagation_.isOpen() ? propagation_.player(panel) : nullptr;
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
  return OverlayLegend{QStringLiteral("Order of update (step of the pass)"), scale(),
                       QStringLiteral("One scale for all panels: a colour is the same step in each")};
}

QString PropagationOverlay::note(int panel) const {
  const PassPlayer* player = this->player(panel);
  if (player == nullptr) {
    return {};
  }
  const QLocale locale;
  QString note = QStringLiteral("pass %1").arg(locale.toString(qulonglong(player->pass().number)));
  if (!propagation_.follows()) {
    note += QStringLiteral(", step %1 of %2")
                .arg(locale.toString(qulonglong(player->step())), locale.toString(qulonglong(player->stepCount())));
  }
  if (const std::size_t every = stride(*player); every > 1) {
    note += QStringLiteral(", 1 step in %1 drawn").arg(every);
  }
  return note;
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
  for (std::size_t row = 0; row < player.step(); row += stride(player)) {
    arrows.add(player.pass().trace[row], row + 1);
  }
  canvas.painter.drawValued(canvas.scene, arrows.places(), arrows.values(), scale(), ObjectDrawing::Shape::segments,
                            arrowWidth);
}

/// Those that moved as discs, those that stayed as rings.
void PropagationOverlay::drawElements(const Canvas& canvas, const PassPlayer& player) const {
  for (const bool moved : {false, true}) {
    std::vector<QVector3D> places;
    std::vector<float> values;
    for (std::size_t row = 0; row < player.step(); row += stride(player)) {
      if (player.pass().trace[row].moved == moved) {
        places.push_back(placeOf(canvas.frame, player.pass().trace[row].element));
        values.push_back(float(row + 1));
      }
    }
    canvas.painter.drawValued(canvas.scene, places, values, scale(),
                              moved ? ObjectDrawing::Shape::discs : ObjectDrawing::Shape::rings, discSize(canvas));
  }
}

/// The hand, what waits, and the candidate that was taken last.
void PropagationOverlay::drawFront(const Canvas& canvas, const PassPlayer& player) const {
  const auto mark = [&](std::span<const ElementId> elements, QColor colour, float size, ObjectDrawing::Mark shape) {
    canvas.painter.drawElements(canvas.scene, elements, colour, size, shape);
  };
  const float disc = discSize(canvas);
  mark(std::span(&player.pass().grabbed, 1), colours::lit, grabbedSize, ObjectDrawing::Mark::disc);
  if (propagation_.follows()) {
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
    canvas.painter.drawInSpace(canvas.scene, arrow.places(), ObjectDrawing::Shape::segments, colours::marked,
                               currentWidth);
  }
}

}  // namespace chainmail
