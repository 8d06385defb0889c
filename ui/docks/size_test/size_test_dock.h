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
#include "docks/size_test/size_test_stage.h"
#include "docks/size_test/size_test_table.h"
#include "docks/size_test/window_rest.h"
#include "document/document.h"

namespace chainmail {

/// The size test: a button that grows a grid under a scripted hand where the panels are, until each has lost real time,
/// and the table of it. The window's own object is not touched; while the test runs, nothing else acts.
class SizeTestDock : public QDockWidget {
  Q_OBJECT

 public:
  using Contestants = std::function<std::vector<SizeTestContestant>()>;

  /// `area` holds the panels, in a box layout of its parent's; `inSight` says which of them can be seen.
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
  SizeTestTable* table_;
  QPushButton* run_;
  QPushButton* cancel_;
  QPushButton* copy_;
  QPushButton* save_;
  QProgressBar* progress_;
  QPointer<SizeTestStage> stage_;  // a closing window takes it along with the panels
  std::unique_ptr<WindowRest> rest_;
  QShortcut* escape_;         // acts while a test runs; made once, as a window that hides looks at each child it had
  QElapsedTimer sinceShown_;  // since the last progress
};

}  // namespace chainmail
