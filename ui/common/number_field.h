#pragma once

#include <QDoubleSpinBox>
#include <optional>

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

}  // namespace chainmail
