#pragma once

#include <QFrame>
#include <QLabel>

namespace chainmail {

/// Says in one sentence what went wrong and what to do, without standing in the way.
class MessageBar : public QFrame {
  Q_OBJECT

 public:
  MessageBar();
  void say(const QString& sentence);
  QString sentence() const { return text_->text(); }

 private:
  QLabel* text_;
};

}  // namespace chainmail
