#pragma once

#include <QObject>

namespace chainmail {

class Actions;
class Colouring;

/// Switches that link the panels: the camera, the range of the colours, and the marks of elements. All are on by
/// default.
class PanelLinks : public QObject {
  Q_OBJECT

 public:
  using QObject::QObject;

  /// Adds the switches to the View menu; `colouring` has that of the colours.
  void fill(Actions& actions, Colouring& colouring);
  bool cameras() const { return cameras_; }
  void setCameras(bool linked);
  /// True if all panels mark the element under the cursor and the selection.
  bool marks() const { return marks_; }

  /// The panel that last contained the mouse. If the marks are not linked, only this panel shows them.
  int pointed() const { return pointed_; }
  void point(int panel) { pointed_ = panel; }

 signals:
  void camerasLinked(bool linked);
  void marksLinked();

 private:
  bool cameras_ = true, marks_ = true;
  int pointed_ = 0;
};

}  // namespace chainmail
