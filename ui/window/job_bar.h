#pragma once

#include <QLabel>
#include <QProgressBar>
#include <QTimer>
#include <QToolButton>
#include <QWidget>

#include "common/jobs.h"

namespace chainmail {

/// Shows in the status bar how far the window's job is, once it takes long enough to be noticed, and cancels it.
class JobBar : public QWidget {
  Q_OBJECT

 public:
  explicit JobBar(Jobs& jobs);

 private:
  void follow();
  void showShare();

  Jobs& jobs_;
  QLabel* text_;
  QProgressBar* share_;
  QToolButton* cancel_;
  QTimer clock_;
};

}  // namespace chainmail
