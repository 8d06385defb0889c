#pragma once

#include <QDockWidget>
#include <QElapsedTimer>
#include <QProgressBar>
#include <QStackedWidget>

#include "docks/report/report_choices.h"
#include "docks/report/report_results.h"

namespace chainmail {

/// Returns the time that a run still takes, as text; nothing if it is too early for an estimate.
QString timeLeft(double share, double seconds);

/// Compares speed and error of the contestants on the object of the window. Shows the choices, a run that can be
/// cancelled, and the results as they come.
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
  void openedByUser();
  void fitTable();
  void placeOverWindow();
  void showState();
  void showProgress(double share, const QString& text);
  void fillBar(int value, const QString& format);

  ReportChoices* choices_;
  ReportResults* results_;
  ReportThread* thread_;
  QPushButton* run_;
  QPushButton* cancel_;
  QProgressBar* progress_;
  QLabel* left_;  // the time that is left
  QStackedWidget* pages_;
  QLabel* empty_ = nullptr;   // the page before the first results
  QElapsedTimer sinceStart_;  // since the run began
  QElapsedTimer sinceShown_;  // since progress was last shown
  QString textShown_;
  bool isPlaced_ = false;  // true after it was placed over the window, from where the user may move it
};

}  // namespace chainmail
