#pragma once

#include <QFrame>
#include <QLabel>
#include <QSize>
#include <QSpinBox>

namespace chainmail {

/// Asks how many elements across a picture's sheet has, without standing in the way.
class SheetBar : public QFrame {
  Q_OBJECT

 public:
  static constexpr int standardAcross = 32;

  SheetBar();

  /// About a picture of so many pixels.
  void ask(const QString& name, QSize picture);

 signals:
  void answered(int across);

 protected:
  bool event(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void arrange();
  void describe();
  void answer();

  QSize picture_;
  QLabel* text_;
  QSpinBox* across_;
  QLabel* result_;
};

}  // namespace chainmail
