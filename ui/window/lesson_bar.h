#pragma once

#include <QFrame>
#include <QLabel>
#include <QPushButton>
#include <QToolButton>

#include "document/lesson_player.h"

class QAction;
class QScrollArea;

namespace chainmail {

/// The bar of an open lesson, below the panels: title, caption, number of the step, Back, Next and Close. At the
/// end, Next gives way to the name of the next lesson.
class LessonBar : public QFrame {
  Q_OBJECT

 public:
  /// The buttons trigger the actions.
  LessonBar(const LessonPlayer& player, QAction& back, QAction& next, QAction& following, QAction& close);

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void refresh();
  void describeButtons();
  void arrange();
  void listen();
  void showTitle();
  void showButtons();
  void keepHeight();
  void showKeys();
  void showStep();
  int roomForStep() const;
  bool isEnded() const { return player_.isLast() && !player_.plays(); }
  void fit();
  void fitFollowing();

  const LessonPlayer& player_;
  QAction &backAction_, &nextAction_, &followingAction_;
  QScrollArea* caption_;
  QLabel *title_, *text_, *step_;
  QPushButton *back_, *next_, *following_, *end_;
  QToolButton* leave_;
};

}  // namespace chainmail
