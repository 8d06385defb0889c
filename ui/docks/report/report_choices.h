#pragma once

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QListWidget>

#include "docks/report/report_thread.h"
#include "document/document.h"

namespace chainmail {

/// Choices for a comparison: its reference, contestants, drags, sweeps, precision and time.
class ReportChoices : public QWidget {
  Q_OBJECT

 public:
  explicit ReportChoices(Document& document);

  /// Returns the chosen run, for the current object of the document.
  ReportThread::Order order() const;
  /// True if at least one contestant and one drag are chosen.
  bool complete() const;

 signals:
  void changed();

 private:
  void arrange();
  void describeAll();
  void fillContestants();
  void fillDrags();
  void drawMarks();
  void adaptToObject();
  void adaptToMesh();
  void adaptToLastDrag();
  bool againstPhysics() const { return against_->currentIndex() == 1; }
  void addContestants(report::PhysicsOptions& options) const;

  Document& document_;
  QComboBox* against_;
  QLabel* noPhysics_;  // why the object cannot be compared with physics
  QListWidget* contestants_;
  QListWidget* drags_;
  QComboBox* sweeps_;
  QComboBox* precision_;
  QDoubleSpinBox* seconds_;
};

}  // namespace chainmail
