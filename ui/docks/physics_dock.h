#pragma once

#include <QDockWidget>
#include <QLabel>

#include "docks/member_rows.h"
#include "document/document.h"

namespace chainmail {

class Actions;

/// Parameters of elastic methods and free-form deformation: material, lattice of control points, and pins.
class PhysicsDock : public QDockWidget {
  Q_OBJECT

 public:
  PhysicsDock(Document& document, const Actions& actions);

 private:
  QLayout* makePins(const Actions& actions);
  void showElastic();
  void showPins();

  Document& document_;
  QLabel* pins_;
  MemberRows<ElasticOptions> rows_;
};

}  // namespace chainmail
