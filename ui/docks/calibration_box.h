#pragma once

#include <QLabel>
#include <QPushButton>
#include <QWidget>

#include "calibrate/calibrate.h"
#include "common/jobs.h"
#include "document/document.h"

namespace chainmail {

/// Looks in the background for the softness with which a ChainMail algorithm comes closest to physics on the object
/// with its pins and material, gives it to the object as one step of undo, and says what error stays.
class CalibrationBox : public QWidget {
  Q_OBJECT

 public:
  CalibrationBox(Document& document, Jobs& jobs);

 signals:
  /// The softness that the object has now is to be kept under a name.
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
