#pragma once

#include <QObject>
#include <vector>

#include "document/document.h"
#include "measure/neighbour_regions.h"
#include "panels/overlay.h"

namespace chainmail {

class Actions;

/// The debugging view (Dean 2004, 5.3). Draws the valid regions of the neighbours of the element under the cursor or in
/// the handle. Without such an element, it uses the selected elements if they are few.
class ValidRegions : public QObject, public Overlay {
  Q_OBJECT

 public:
  explicit ValidRegions(const Document& document);

  void fill(Actions& actions);
  void draw(const Canvas& canvas) override;
  QString note(int panel) const override;

 signals:
  /// The picture has changed.
  void changed();

 private:
  /// Returns the elements whose neighbours are shown.
  std::vector<ElementId> elements() const;
  void draw(const Canvas& canvas, const NeighbourRegion& region) const;

  const Document& document_;
  bool shown_ = false;
};

}  // namespace chainmail
