#pragma once

#include <QLabel>
#include <QPushButton>
#include <QWidget>

#include "calibrate/calibrate.h"
#include "common/jobs.h"
#include "document/document.h"

namespace chainmail {

/// Searches in the background for the softness with which a ChainMail algorithm comes closest to FEM on this object,
/// with its pins and material. Sets the softness as one undo step and shows the remaining error.
class CalibrationBox : public QWidget {
  Q_OBJECT

 public:
  CalibrationBox(Document& document, Jobs& jobs);

 signals:
  /// Emitted when the user wants to save the current softness as a preset.
  void presetRequested();

 private:
  void arrange();
  void adapt();
  QString whyNot() const;
  Algorithm algorithm() const;
  void start();
  void take(const CalibrationResult& result, const CalibrationOptions& options);

  Document& document_;
  Jobs& jobs_;
  QPushButton* start_;
  QPushButton* keep_;
  QLabel* result_;
};

}  // namespace chainmail
