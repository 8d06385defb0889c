#pragma once

#include <QAction>
#include <QDockWidget>
#include <QElapsedTimer>
#include <QPointer>
#include <QProgressBar>
#include <QPushButton>
#include <QShortcut>
#include <functional>
#include <memory>

#include "docks/size_test/size_test_choices.h"
#include "docks/size_test/size_test_results.h"
#include "docks/size_test/size_test_stage.h"
#include "docks/size_test/window_rest.h"
#include "document/document.h"

namespace chainmail {

/// The size test: grows a grid and drags it by a script until no panel is in real time, and shows the results in a
/// table. While the test runs, its own panels replace those of the window, and the rest of the window is disabled. The
/// object of the window does not change.
class SizeTestDock : public QDockWidget {
  Q_OBJECT

 public:
  using Contestants = std::function<std::vector<SizeTestContestant>()>;

  /// `area` contains the panels and is in a box layout of its parent. `inSight` returns the visible panels.
  SizeTestDock(QMainWindow& window, const Document& document, QWidget& area, Contestants inSight);
  ~SizeTestDock() override;

  bool running() const { return !stage_.isNull(); }
  void start();
  void cancel();
  void saveTablePath(const QString& path);

 signals:
  void saved(const QString& path);
  void failed(const QString& sentence);

 private:
  void followPanels();
  void offerRun();
  QWidget* makeControls();
  void listen(const SizeTestStage& stage);
  void leave();
  void retire(SizeTestStage* stage);
  void showState();
  void showProgress(double share, const QString& text);
  void fillBar(int value, const QString& text);
  void saveTable();

  QMainWindow& window_;
  const Document& document_;
  QWidget& area_;
  Contestants inSight_;
  SizeTestChoices* choices_;
  SizeTestResults* results_;
  QPushButton* run_;
  QPushButton* cancel_;
  QPushButton* copy_;
  QPushButton* save_;
  QProgressBar* progress_;
  QPointer<SizeTestStage> stage_;  // a closing window deletes the stage together with the panels
  std::unique_ptr<WindowRest> rest_;
  // Enabled while a test runs. It is not deleted after a test: Qt visits all children of a window that hides, also a
  // child that is deleted meanwhile.
  QShortcut* escape_;
  QElapsedTimer sinceShown_;  // since progress was last shown
};

}  // namespace chainmail
