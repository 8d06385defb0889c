#pragma once

#include <QDockWidget>
#include <QElapsedTimer>
#include <QLabel>
#include <QTimer>
#include <array>
#include <vector>

#include "colours.h"
#include "document.h"

class QLineSeries;
class QValueAxis;

namespace chainmail {

class Panel;

/// How fast each panel is: frames painted, and the time of a pass, told apart because the drawing and
/// not the solver may set the painted rate. Refreshes only while something happens.
class FrameRateDock : public QDockWidget {
  Q_OBJECT

 public:
  FrameRateDock(Document& document, std::vector<Panel*> panels, const std::vector<colours::Colour>& colours);

 private:
  struct Column {
    QLabel *painted, *passes, *median, *worst;
    QLineSeries* series;
    std::uint64_t passesSeen = 0;
  };

  void refresh();
  bool refresh(int panel, double now);
  QWidget* makeChart(const std::vector<colours::Colour>& colours);
  void scaleChart(double now);

  Document& document_;
  std::vector<Panel*> panels_;
  std::array<Column, Document::panels> columns_{};
  QValueAxis* time_;
  QValueAxis* milliseconds_;
  QElapsedTimer clock_;
  QTimer timer_;
};

}  // namespace chainmail
