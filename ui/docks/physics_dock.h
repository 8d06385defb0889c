#pragma once

#include <QDockWidget>
#include <QLabel>

#include "docks/member_rows.h"
#include "document/document.h"
#include "tools/pin_tool.h"

namespace chainmail {

/// Parameters of elastic methods and free-form deformation: material, lattice of control points, and pins.
class PhysicsDock : public QDockWidget {
  Q_OBJECT

 public:
  PhysicsDock(Document& document, PinLayers& layers);

 private:
  QLayout* makePins(PinLayers& layers);
  void showElastic();
  void showPins();

  Document& document_;
  QLabel* pins_;
  MemberRows<ElasticOptions> rows_;
};

}  // namespace chainmail
