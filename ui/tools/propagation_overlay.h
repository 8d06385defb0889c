#pragma once

#include "document/propagation.h"
#include "panels/overlay.h"

namespace chainmail {

/// What a pass did, drawn over the objects: elements coloured by the order in which they were updated, and arrows to
/// each from its sponsor.
class PropagationOverlay : public Overlay {
 public:
  explicit PropagationOverlay(const Propagation& propagation) : propagation_(propagation) {}

  void setArrows(bool arrows) { arrows_ = arrows; }
  bool arrows() const { return arrows_; }

  std::optional<ObjectDrawing::Paint> paint(int panel) const override;
  void draw(const Canvas& canvas) override;
  QString note(int panel) const override;
  std::optional<OverlayLegend> legend(int panel) const override;
  /// One scale for all panels: from the first step to the last of the longest pass.
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
