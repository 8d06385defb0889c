#pragma once

#include <QFrame>
#include <QHBoxLayout>
#include <QLabel>

class QPushButton;

namespace chainmail {

/// Asks what a job needs to know before it begins, in a line above the panels, without standing in the way: Enter
/// agrees, Escape leaves.
class AskBar : public QFrame {
  Q_OBJECT

 signals:
  void agreed();

 protected:
  /// `name` goes before the names that its parts are found by; `agree` is what its button says.
  AskBar(const QString& name, const QString& agree, const QString& help);

  /// Adds a field with its label before it; where that is empty the field says itself what it is.
  void addField(const QString& label, QWidget* field);
  /// Says what it is about, and waits for an answer with the keyboard in `field`.
  void ask(const QString& about, QWidget* field);
  /// Adds another answer beside its button, once all fields are there.
  void addAnswer(QPushButton* answer);
  /// What its button says from now on.
  void setAgree(const QString& text);
  /// What would come of the answer as it stands; it is no answer where nothing would.
  void showResult(const QString& result, bool possible = true);

  bool event(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void agree();

  QHBoxLayout* fields_;
  QLabel* about_;
  QLabel* result_;
  QPushButton* agree_;
};

}  // namespace chainmail
