#pragma once

#include <QFrame>
#include <QHBoxLayout>
#include <QLabel>

class QPushButton;

namespace chainmail {

/// A bar above the panels that asks for the inputs of a job before it starts. Enter confirms, Escape cancels.
class AskBar : public QFrame {
  Q_OBJECT

 signals:
  void agreed();

 protected:
  /// `name` is the prefix of the object names of its parts; `agree` is the text of its button, `help` the tooltip.
  AskBar(const QString& name, const QString& agree, const QString& help);

  /// Adds a field and a label before it, unless the label is empty.
  void addField(const QString& label, QWidget* field);
  /// Shows the bar with a text, and gives the keyboard focus to `field`.
  void ask(const QString& about, QWidget* field);
  /// Adds another answer next to its button. Call it after all fields are added.
  void addAnswer(QPushButton* answer);
  /// Sets the text of its button.
  void setAgree(const QString& text);
  /// Shows the expected result of the current inputs. Disables the button if `possible` is false.
  void showResult(const QString& result, bool possible = true);
  /// Shows a longer text below the others, which may break lines; none if it is empty.
  void showDetails(const QString& details);

  bool event(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void agree();

  QHBoxLayout* fields_;
  QLabel* about_;
  QLabel* result_;
  QLabel* details_;
  QPushButton* agree_;
};

}  // namespace chainmail
