#pragma once

#include <QComboBox>
#include <QDockWidget>
#include <QElapsedTimer>
#include <QLabel>
#include <QTimer>
#include <QWidget>
#include <vector>

#include "common/colours.h"
#include "common/plot_widget.h"
#include "docks/rate_history.h"
#include "document/document.h"

class QGridLayout;

namespace chainmail {

class Actions;
class Panel;

/// Shows the newest figures of each panel, with its colour and algorithm: painted rate and times of the solver.
class RateFigures : public QWidget {
  Q_OBJECT

 public:
  explicit RateFigures(const Document& document);
  /// Shows a sample. If the sample has no figures of passes, the earlier ones stay.
  void show(int panel, const RateSample& sample);
  /// Removes the figures of the algorithm or the object before.
  void clear(int panel);

 private:
  struct Row {
    QLabel *name, *painted, *passes, *median, *worst;
  };

  void addHead(QGridLayout& grid);
  void addRow(QGridLayout& grid);
  void followPanels();
  void nameRow(int panel);

  const Document& document_;
  std::vector<Row> rows_;
};

/// Shows the speed of each panel as figures and over time: painted frames per second, and the time of a pass (ms). They
/// differ because drawing may limit the painted rate. The dock reads and draws only while something happens.
class FrameRateDock : public QDockWidget {
  Q_OBJECT

 public:
  /// Largest number of points to draw, for all panels together.
  static constexpr std::size_t drawnPoints = 2000;

  /// `panels` are the current panels of the document.
  FrameRateDock(Document& document, const std::vector<Panel*>& panels, Actions& actions);

  /// Writes all samples as CSV.
  void saveTablePath(const QString& path);
  /// Writes the plot as SVG, PDF or PNG.
  void savePicturePath(const QString& path);

 signals:
  void saved(const QString& path);
  void failed(const QString& sentence);

 private:
  /// What the newest sample of a panel is about.
  struct Seen {
    std::uint64_t passes = 0;
    std::chrono::steady_clock::time_point measured{};
  };

  void fillChoices();
  QWidget* makeControls(const Actions& actions);
  void addActions(Actions& actions);
  void receive(int panel);
  void forget(int panel);
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
  std::vector<Seen> seen_;
  MeshPointer object_;  // Document::unsplitMesh() of the figures
  RateFigures* figures_;
  PlotWidget* plot_;
  QComboBox* quantity_;
  QComboBox* span_;
  bool pauses_ = false;
  QElapsedTimer clock_;
  double shownTo_ = 0;  // end of the plot (s since the window was opened); stays while nothing happens
  QTimer timer_;
};

}  // namespace chainmail
