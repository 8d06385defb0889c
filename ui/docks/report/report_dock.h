#pragma once

#include <QDockWidget>
#include <QElapsedTimer>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QStackedWidget>

#include "docks/report/report_choices.h"
#include "docks/report/report_results.h"
#include "docks/report/report_thread.h"

namespace chainmail {

/// Compares speed and error of the algorithms on the object of the window. Shows the choices, a run that can be
/// cancelled, and the results.
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
  void openedByUser();
  void fitTable();
  void placeOverWindow();
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
  QLabel* empty_ = nullptr;   // the page before the first results
  QElapsedTimer sinceShown_;  // since progress was last shown
  QString textShown_;
  bool isPlaced_ = false;  // true after it was placed over the window, from where the user may move it
};

}  // namespace chainmail
