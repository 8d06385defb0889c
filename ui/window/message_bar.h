#pragma once

#include <QFrame>
#include <QLabel>
#include <vector>

class QToolButton;

namespace chainmail {

enum class Severity { info, warning, error };

/// Shows messages: one sentence that says what happened and what to do. The bar shows the newest message. Older
/// messages appear when the newer ones are dismissed.
class MessageBar : public QFrame {
  Q_OBJECT

 public:
  MessageBar();

  /// Shows an error: something failed.
  void say(const QString& sentence) { add(Severity::error, sentence); }
  /// Shows a warning: the result differs from the request.
  void warn(const QString& sentence) { add(Severity::warning, sentence); }
  /// Shows a note.
  void note(const QString& sentence) { add(Severity::info, sentence); }
  /// Removes a message that is no longer true, if it is still there.
  void retract(const QString& sentence);
  /// Removes the shown message. The bar then shows the previous one.
  void dismiss();
  /// Removes all messages. Hiding the bar also does this.
  void clear();

  /// Returns the shown message; empty if there is none.
  QString sentence() const { return messages_.empty() ? QString() : messages_.back().sentence; }
  Severity severity() const { return messages_.empty() ? Severity::info : messages_.back().severity; }
  /// Number of messages, including the shown one.
  int count() const { return int(messages_.size()); }

 protected:
  void hideEvent(QHideEvent* event) override;

 private:
  struct Message {
    Severity severity;
    QString sentence;
    bool operator==(const Message&) const = default;
  };

  void add(Severity severity, const QString& sentence);
  void refresh();
  void paintGround();

  std::vector<Message> messages_;  // the newest last
  QLabel* sign_;
  QLabel* text_;
  QLabel* waiting_;
  QToolButton* all_;
  QToolButton* close_;
};

}  // namespace chainmail
