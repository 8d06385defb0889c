#pragma once

#include <QLabel>
#include <QWidget>
#include <vector>

#include "common/colours.h"
#include "docks/frame_rate/rate_history.h"
#include "document/document.h"

class QGridLayout;

namespace chainmail {

/// The newest figures of each panel under its colour and its algorithm: what is painted, and what the solver does.
class RateFigures : public QWidget {
  Q_OBJECT

 public:
  explicit RateFigures(const Document& document);
  /// Shows what a sample holds; of passes, what was shown before stays where it holds none.
  void show(int panel, const RateSample& sample);

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
