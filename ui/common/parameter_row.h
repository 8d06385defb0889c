#pragma once

#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QLabel>
#include <QSlider>
#include <QToolButton>
#include <QWidget>

#include "mesh/parameters.h"

namespace chainmail {

/// Docks are at least this wide (pixels), so that changing figures do not push the panels about.
inline constexpr int dockWidth = 230;

/// One parameter: its name, a slider, a spin box, and a button back to the default.
class ParameterRow : public QWidget {
  Q_OBJECT

 public:
  /// `prefix` goes before the names that its parts are found by.
  explicit ParameterRow(const Parameter& parameter, const QString& prefix = {});

  double value() const { return spin_->value(); }
  QString label() const { return label_->text(); }
  /// Shows a value without announcing it.
  void show(double value);

 signals:
  /// Changes of one gesture (a drag of the slider, a run of wheel notches) carry the same number.
  void changed(double value, int gesture);

 private:
  void describe(const QString& prefix);
  void announce(double value);
  int toSlider(double value) const;

  const Parameter& parameter_;
  QLabel* label_;
  QSlider* slider_;
  QDoubleSpinBox* spin_;
  QToolButton* reset_;
  QElapsedTimer sinceChange_;
  int gesture_ = 0;
};

}  // namespace chainmail
