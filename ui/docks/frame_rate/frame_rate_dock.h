#pragma once

#include <QAction>
#include <QComboBox>
#include <QDockWidget>
#include <QElapsedTimer>
#include <QMenu>
#include <QTimer>
#include <vector>

#include "common/plot_widget.h"
#include "docks/frame_rate/rate_figures.h"
#include "document/document.h"

namespace chainmail {

class Panel;

/// How fast each panel is: frames painted, and the time of a pass, told apart because the drawing and not the solver
/// may set the painted rate; as figures, and over time. Reads and draws only while something happens.
class FrameRateDock : public QDockWidget {
  Q_OBJECT

 public:
  /// So many points are drawn at most, of all panels together.
  static constexpr std::size_t drawnPoints = 2000;

  /// `panels` are those of the document, as they come and go.
  FrameRateDock(Document& document, const std::vector<Panel*>& panels);

  /// What can be done here, for a menu of the window's.
  QMenu& menu() { return *menu_; }
  /// Everything that was read, as CSV.
  void saveTablePath(const QString& path);
  /// What the plot shows, as PNG or PDF.
  void savePicturePath(const QString& path);

 signals:
  void saved(const QString& path);
  void failed(const QString& sentence);

 private:
  void fillChoices();
  QWidget* makeControls();
  void addActions();
  void receive(int panel);
  double now() const { return 1e-9 * double(clock_.nsecsElapsed()); }
  RateSample read(int panel);
  void refresh();
  void showPlot();
  void choose();
  report::Plot plotOn(colours::Ground ground) const;
  void saveTable();
  void savePicture();
  void attempt(const QString& path, const std::function<void()>& write);

  Document& document_;
  const std::vector<Panel*>& panels_;
  std::vector<RateHistory> histories_;
  std::vector<std::uint64_t> passesSeen_;
  RateFigures* figures_;
  PlotWidget* plot_;
  QComboBox* quantity_;
  QComboBox* span_;
  QMenu* menu_;
  QAction* pause_ = nullptr;
  QElapsedTimer clock_;
  double shownTo_ = 0;  // s on the clock: where the plot ends; it stands still while nothing happens
  QTimer timer_;
};

}  // namespace chainmail
