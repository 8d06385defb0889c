#pragma once

#include <QAction>
#include <QMenu>
#include <vector>

#include "document/document.h"

namespace chainmail {

class PanelArea;

/// The View menu's looks along the axes, and the choice between perspective and parallel rays. Both ask for an object
/// that has depth.
class AxisViews : public QObject {
  Q_OBJECT

 public:
  AxisViews(QObject* owner, const Document& document, const PanelArea& area);

  void fill(QMenu& menu);

 private:
  void adapt();

  const Document& document_;
  const PanelArea& area_;
  std::vector<QAction*> actions_;
};

}  // namespace chainmail
