#pragma once

#include <QMessageBox>
#include <QPushButton>

#include "io/autosave.h"
#include "io/sessions.h"
#include "session_bench.h"

namespace chainmail {

/// A workbench with automatic saving, whose timer the test starts.
struct SafeBench : Workbench {
  SafeBench() {
    window.sessions().protect();
    timer = find<QTimer>("autosaveTimer");
  }
  /// Writes what is unsaved, or tries to.
  void save() {
    settle();
    timer->start(0);
    QTRY_VERIFY(!timer->isActive() || timer->remainingTime() > 0);
    QTRY_VERIFY_WITH_TIMEOUT(!window.findChild<Autosave*>()->isWriting(), longestWait);
    settle();
  }

  QTimer* timer = nullptr;
};

/// Clicks a button of the next question, and counts the questions.
class Answer : public QObject {
 public:
  explicit Answer(const QString& button) {
    timer_.setInterval(10);
    connect(&timer_, &QTimer::timeout, this, [this, button] {
      auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
      for (QAbstractButton* one : box != nullptr ? box->buttons() : QList<QAbstractButton*>()) {
        if (one->text().remove(QLatin1Char('&')) == button) {
          ++questions;
          said = box->text() + QLatin1Char('\n') + box->informativeText();
          timer_.stop();
          one->click();
          return;
        }
      }
    });
    timer_.start();
  }

  int questions = 0;
  QString said;

 private:
  QTimer timer_;
};

}  // namespace chainmail
