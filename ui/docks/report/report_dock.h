#pragma once

#include <QComboBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QLabel>
#include <QListWidget>
#include <QProgressBar>
#include <QPushButton>
#include <QStackedWidget>

#include "docks/report/report_results.h"
#include "docks/report/report_thread.h"
#include "document/document.h"

namespace chainmail {

/// Choices for a comparison: drags, algorithms, sweeps, precision and time limit.
class ReportChoices : public QWidget {
  Q_OBJECT

 public:
  explicit ReportChoices(Document& document);

  /// Returns the chosen run, for the current object of the document.
  ReportThread::Order order() const;
  /// True if at least one algorithm is chosen.
  bool complete() const { return !chosen().empty(); }

 signals:
  void changed();

 private:
  void fillDrags();
  void fillAlgorithms();
  void fillRest();
  void adaptToMesh();
  void adaptToLastDrag();
  std::vector<Algorithm> chosen() const;

  Document& document_;
  QComboBox* drags_;
  QListWidget* algorithms_;
  QComboBox* sweeps_;
  QComboBox* precision_;
  QDoubleSpinBox* seconds_;
};

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
