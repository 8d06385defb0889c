#pragma once

#include <QFrame>
#include <QLabel>
#include <vector>

class QToolButton;

namespace chainmail {

enum class Severity { info, warning, error };

/// Says in one sentence what happened and what to do, without standing in the way. What is newest is shown; what it
/// covers waits until that was dismissed, so that no sentence is lost.
class MessageBar : public QFrame {
  Q_OBJECT

 public:
  MessageBar();

  /// Something could not be done.
  void say(const QString& sentence) { add(Severity::error, sentence); }
  /// Something was not done as asked, or may surprise.
  void warn(const QString& sentence) { add(Severity::warning, sentence); }
  /// Something was done that is worth knowing.
  void note(const QString& sentence) { add(Severity::info, sentence); }
  /// Takes the sentence away that is shown; the one before it is shown again.
  void dismiss();
  /// Takes all away, as hiding the bar does.
  void clear();

  /// What is shown; empty where nothing is.
  QString sentence() const { return messages_.empty() ? QString() : messages_.back().sentence; }
  Severity severity() const { return messages_.empty() ? Severity::info : messages_.back().severity; }
  /// How many sentences there are, with the one that is shown.
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
