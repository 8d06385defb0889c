#pragma once

#include "document/propagation.h"
#include "panels/overlay.h"

namespace chainmail {

/// Draws a pass over the objects: elements coloured by the order of their updates, and arrows from their sponsors.
class PropagationOverlay : public Overlay {
 public:
  explicit PropagationOverlay(const Propagation& propagation) : propagation_(propagation) {}

  void setArrows(bool arrows) { arrows_ = arrows; }
  bool arrows() const { return arrows_; }

  /// Neutral, so that only the candidates have colours; none for a panel whose pass is not shown.
  std::optional<ObjectDrawing::Paint> paint(int panel) const override;
  void draw(const Canvas& canvas) override;
  QString note(int panel) const override;
  bool isInMidPass(int panel) const override;
  std::optional<OverlayLegend> legend(int panel) const override;
  /// The colour scale, which is the same for all panels: from the first step to the last step of the longest pass.
  ColourScale scale() const;

 private:
  const PassPlayer* player(int panel) const;
  void drawArrows(const Canvas& canvas, const PassPlayer& player) const;
  void drawElements(const Canvas& canvas, const PassPlayer& player) const;
  void drawFront(const Canvas& canvas, const PassPlayer& player) const;

  const Propagation& propagation_;
  bool arrows_ = true;
};

}  // namespace chainmail
