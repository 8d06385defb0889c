#pragma once

#include <QFrame>

namespace chainmail {

/// Three short hints for the first start. They are below the views and do not cover them.
class Hints : public QFrame {
  Q_OBJECT

 public:
  Hints();

  /// True if the hints were shown before.
  static bool seen();
  void present();

 signals:
  /// The user wants to begin with a lesson.
  void lessonRequested();
};

}  // namespace chainmail
