#pragma once

#include <QLabel>
#include <QProgressBar>
#include <QTimer>
#include <QToolButton>
#include <QWidget>

#include "common/jobs.h"

namespace chainmail {

/// Shows the progress of a background job in the status bar after 0.2 s, with a button that cancels it.
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
