#pragma once

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QListWidget>

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

}  // namespace chainmail
