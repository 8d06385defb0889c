#pragma once

#include <QFrame>

namespace chainmail {

/// Three short hints for the first start, over the views' lower edge.
class Hints : public QFrame {
  Q_OBJECT

 public:
  explicit Hints(QWidget& over);

  /// Whether they were shown on this machine before.
  static bool seen();
  void present();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void place();
};

}  // namespace chainmail
