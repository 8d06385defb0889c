#pragma once

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QListWidget>

#include "docks/report/report_thread.h"
#include "document/document.h"

namespace chainmail {

/// Choices for a comparison: drags, algorithms, sweeps, precision and time.
class ReportChoices : public QWidget {
  Q_OBJECT

 public:
  explicit ReportChoices(Document& document);

  /// Returns a run on the present object of the document.
  ReportThread::Order order() const;
  /// True if an algorithm is chosen.
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
