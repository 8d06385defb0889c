#pragma once

#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QLabel>
#include <QSlider>
#include <QToolButton>
#include <QWidget>
#include <optional>

#include "mesh/parameters.h"

namespace chainmail {

/// A spin box that also accepts numbers such as 1e3 and 0,5. If a number is outside its range, it keeps the former
/// value and explains its limits in a sentence. It neither shows nor accepts separators of thousands: 1,234 could mean
/// two numbers.
class NumberField : public QDoubleSpinBox {
  Q_OBJECT

 public:
  /// `label` is the name of the number in the sentence.
  explicit NumberField(const QString& label);

  QValidator::State validate(QString& text, int& at) const override;
  double valueFromText(const QString& text) const override;
  void fixup(QString& text) const override;

 private:
  std::optional<double> read(const QString& text) const;

  QString label_;
};

/// A row for one parameter: its name, a slider, a spin box, and a button that resets it to the default.
class ParameterRow : public QWidget {
  Q_OBJECT

 public:
  /// `prefix` starts the object names of its parts.
  explicit ParameterRow(const Parameter& parameter, const QString& prefix = {});

  double value() const { return spin_->value(); }
  QString label() const { return label_->text(); }
  /// Shows a value without emitting changed().
  void show(double value);
  /// Disables the row and shows the reason as its tooltip. Without a reason, enables it.
  void disable(const QString& why);

 signals:
  /// Emitted when the user changes the value. All changes of one gesture (a drag of the slider, a series of wheel
  /// steps) have the same `gesture` number.
  void changed(double value, int gesture);

 private:
  void describe(const QString& prefix);
  void announce(double value);
  int toSlider(double value) const;

  const Parameter& parameter_;
  QString help_;  // tooltip while enabled
  QLabel* label_;
  QSlider* slider_;
  QDoubleSpinBox* spin_;
  QToolButton* reset_;
  QElapsedTimer sinceChange_;
  int gesture_ = 0;
};

}  // namespace chainmail
