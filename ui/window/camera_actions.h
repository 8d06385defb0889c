#pragma once

#include <QAction>
#include <QMenu>
#include <QObject>
#include <functional>
#include <vector>

#include "panels/view.h"

namespace chainmail {

class Document;
class PanelArea;
class Panel;

/// The camera actions of the View menu: turn, pan and zoom by keyboard; views along the axes; perspective or parallel
/// projection.
///
/// The keys that turn, pan and zoom work in the view that has the keyboard focus, because the same keys move the cursor
/// in lists and fields. Views along the axes and the projection act on all panels and need an object in 3D space.
class CameraActions : public QObject {
  Q_OBJECT

 public:
  CameraActions(QObject* parent, const Document& document, PanelArea& area);
  /// Adds the submenu with the actions that turn, pan and zoom.
  void fillMoves(QMenu& menu) const;
  /// Adds the submenu with the views along the axes, the choice of the axis that points up, and the projection.
  void fillSides(QMenu& menu);

 private:
  void makeMoves();
  void add(const char* name, const QString& text, const char* icon, const QList<QKeySequence>& keys, const QString& tip,
           const std::function<void(View&)>& act);
  void attach(Panel& panel);
  View* focusedView() const;
  void addUp(QMenu& menu);
  void addProjection(QMenu& menu);
  void adapt();

  const Document& document_;
  PanelArea& area_;
  std::vector<QAction*> moves_;
  QAction* upZ_ = nullptr;
  std::vector<QAction*> sides_;  // views along the axes and projection: they need a third dimension
};

}  // namespace chainmail
