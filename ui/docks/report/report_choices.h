#pragma once

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QListWidget>

#include "docks/report/report_thread.h"
#include "document/document.h"

namespace chainmail {

/// What to compare: which drags, who takes part, with how many sweeps, in which precision, how thoroughly.
class ReportChoices : public QWidget {
  Q_OBJECT

 public:
  explicit ReportChoices(Document& document);

  /// A run on the object as the document has it now.
  ReportThread::Order order() const;
  /// Whether there is anyone to compare.
  bool complete() const { return !chosen().empty(); }

 signals:
  void changed();

 private:
  void fillDrags();
  void fillAlgorithms();
  void fillRest();
  void adaptToMesh();
  void adaptToHand();
  std::vector<Algorithm> chosen() const;

  Document& document_;
  QComboBox* drags_;
  QListWidget* algorithms_;
  QComboBox* sweeps_;
  QComboBox* precision_;
  QDoubleSpinBox* seconds_;
};

}  // namespace chainmail
