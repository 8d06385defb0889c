#pragma once

#include <QObject>
#include <vector>

#include "document/document.h"
#include "measure/neighbour_regions.h"
#include "panels/overlay.h"

class QAction;
class QMenu;

namespace chainmail {

/// The debugging view (Dean 2004, 5.3): draws the valid regions of the neighbours of the element under the cursor or in
/// the hand, or else of the few that are selected, about where each stands.
class ValidRegions : public QObject, public Overlay {
  Q_OBJECT

 public:
  explicit ValidRegions(const Document& document);

  /// Adds the switch to a menu.
  void fill(QMenu& menu);
  void draw(const Canvas& canvas) override;
  QString note(int panel) const override;

 signals:
  /// There is something else to paint.
  void changed();

 private:
  /// Whose neighbours' regions are drawn.
  std::vector<ElementId> elements() const;
  void draw(const Canvas& canvas, const NeighbourRegion& region) const;

  const Document& document_;
  QAction* shown_;
};

}  // namespace chainmail
