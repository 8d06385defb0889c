#pragma once

#include <QAction>
#include <QObject>

namespace chainmail {

class Colouring;

/// Switches that link the panels: the camera, the range of the colours, and the marks of elements. All are on by
/// default.
class PanelLinks : public QObject {
  Q_OBJECT

 public:
  PanelLinks(Colouring& colouring, QObject* parent);

  /// The switches, for a menu and the tool bar.
  QList<QAction*> actions() const { return {cameras_, colours_, marks_}; }
  bool cameras() const { return cameras_->isChecked(); }
  void setCameras(bool linked) { cameras_->setChecked(linked); }
  /// True if all panels mark the element under the cursor and the selection.
  bool marks() const { return marks_->isChecked(); }

  /// The panel that last contained the mouse. If the marks are not linked, only this panel shows them.
  int pointed() const { return pointed_; }
  void point(int panel) { pointed_ = panel; }

 signals:
  void camerasLinked(bool linked);
  void marksLinked();

 private:
  QAction* makeSwitch(const char* name, const QString& text, const QString& iconText, const QKeySequence& key,
                      const QString& statusTip);

  QAction* cameras_;
  QAction* colours_;
  QAction* marks_;
  int pointed_ = 0;
};

}  // namespace chainmail
