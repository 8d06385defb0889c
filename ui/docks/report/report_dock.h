#pragma once

#include <QDockWidget>
#include <QElapsedTimer>
#include <QProgressBar>
#include <QPushButton>
#include <QStackedWidget>

#include "docks/report/report_choices.h"
#include "docks/report/report_results.h"
#include "docks/report/report_thread.h"

namespace chainmail {

/// Speed against error on the object in the window: choices, a run that can be cancelled, its results.
class ReportDock : public QDockWidget {
  Q_OBJECT

 public:
  explicit ReportDock(Document& document);

 signals:
  void saved(const QString& path);
  void failed(const QString& sentence);

 private:
  QWidget* makeControls();
  QWidget* makeEmptyPage();
  void listen();
  void start();
  void cancel();
  void showState();
  void showProgress(double fraction, const QString& text);
  void fillBar(int value, const QString& format);

  ReportChoices* choices_;
  ReportResults* results_;
  ReportThread* thread_;
  QPushButton* run_;
  QPushButton* cancel_;
  QProgressBar* progress_;
  QStackedWidget* pages_;
  QElapsedTimer sinceShown_;  // since the last progress
  QString textShown_;
};

}  // namespace chainmail
