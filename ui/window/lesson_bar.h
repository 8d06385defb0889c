#pragma once

#include <QFrame>
#include <QLabel>
#include <QPushButton>

#include "document/lesson_player.h"

class QAction;

namespace chainmail {

/// The bar of an open lesson, below the panels: title, caption, number of the step, Back, Next and Close.
class LessonBar : public QFrame {
  Q_OBJECT

 public:
  /// The buttons trigger the actions.
  LessonBar(const LessonPlayer& player, QAction& back, QAction& next, QAction& close);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void refresh();
  void showTitle();
  void showKeys();

  const LessonPlayer& player_;
  QAction &backAction_, &nextAction_;
  QLabel *title_, *text_, *step_;
  QPushButton *back_, *next_;
};

}  // namespace chainmail
