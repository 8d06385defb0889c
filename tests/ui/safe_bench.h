#pragma once

#include <QDir>
#include <QFile>
#include <QMessageBox>
#include <QPushButton>

#include "io/autosave.h"
#include "io/sessions.h"
#include "io/unsaved_work.h"
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

/// Makes a folder where nothing can be written, also by root: a file has its name.
class FullDisk {
 public:
  FullDisk() : path_(unsaved_work::folder()), aside_(path_ + QStringLiteral("-aside")) {
    QVERIFY(QDir().rename(path_, aside_));
    QFile file(path_);
    QVERIFY(file.open(QIODevice::WriteOnly));
  }
  ~FullDisk() { end(); }
  void end() {
    if (!aside_.isEmpty()) {
      QFile::remove(path_);
      QDir().rename(aside_, path_);
      aside_.clear();
    }
  }

 private:
  QString path_, aside_;
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
