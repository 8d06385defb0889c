#pragma once

#include <QLabel>
#include <QWidget>
#include <vector>

#include "common/colours.h"
#include "docks/frame_rate/rate_history.h"
#include "document/document.h"

class QGridLayout;

namespace chainmail {

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

}  // namespace chainmail
