#pragma once

#include <QFrame>

namespace chainmail {

/// Three short hints for the first start, below the views, which they do not cover.
class Hints : public QFrame {
  Q_OBJECT

 public:
  Hints();

  /// True if the hints were shown before.
  static bool seen();
  void present();
};

}  // namespace chainmail
