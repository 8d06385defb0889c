#pragma once

#include <QFrame>

namespace chainmail {

/// Three short hints for the first start, in a row of their own under the views: they cover nothing.
class Hints : public QFrame {
  Q_OBJECT

 public:
  Hints();

  /// Whether they were shown on this machine before.
  static bool seen();
  void present();
};

}  // namespace chainmail
