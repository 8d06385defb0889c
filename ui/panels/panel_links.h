#pragma once

#include <QAction>
#include <QObject>

namespace chainmail {

class Colouring;

/// What the panels share of how they are looked at: the camera, the range of the colours, and the marks of elements.
/// Each is a switch, on at first.
class PanelLinks : public QObject {
  Q_OBJECT

 public:
  PanelLinks(Colouring& colouring, QObject* parent);

  /// For a menu and the tool bar.
  QList<QAction*> actions() const { return {cameras_, colours_, marks_}; }
  bool cameras() const { return cameras_->isChecked(); }
  void setCameras(bool linked) { cameras_->setChecked(linked); }
  /// Whether what the cursor is at, and what is selected, is marked in all panels.
  bool marks() const { return marks_->isChecked(); }

  /// The panel that the mouse was in last: marks that are not mirrored are shown there.
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
