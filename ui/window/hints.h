#pragma once

#include <QFrame>

namespace chainmail {

/// Three short hints for the first start.
class Hints : public QFrame {
  Q_OBJECT

 public:
  Hints();

  /// True if the hints were shown before.
  static bool seen();
  void present();
  /// While set aside, the hints are hidden; afterwards they are as before. present() shows them all the same.
  void setAside(bool aside);
  void setVisible(bool visible) override;

 signals:
  /// The user wants to begin with a lesson.
  void lessonRequested();

 private:
  bool wanted_ = false;  // visible unless set aside
  bool aside_ = false;
};

}  // namespace chainmail
