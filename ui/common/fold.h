#pragma once

#include <QToolButton>
#include <QVBoxLayout>
#include <QWidget>

namespace chainmail {

/// A column of rarely used fields below a button that shows and hides them. Hidden at first; the choice is remembered.
class Fold : public QWidget {
  Q_OBJECT

 public:
  /// `name` is the name of the button, and of the choice in the settings.
  Fold(const QString& title, const QString& name, const QString& help);

  QVBoxLayout& column() { return *column_; }
  /// Says beside the title that a hidden field is not at its default, because it counts all the same.
  void setChanged(bool changed);

 private:
  void unfold(bool unfolded);

  QString title_;
  QToolButton* button_;
  QWidget* content_;
  QVBoxLayout* column_;
};

}  // namespace chainmail
