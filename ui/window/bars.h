#pragma once

#include <QFrame>
#include <QLabel>
#include <QPointer>
#include <QProgressBar>
#include <QTimer>
#include <QToolButton>
#include <QWidget>
#include <vector>

#include "common/jobs.h"

class QVBoxLayout;

namespace chainmail {

class Panel;
class PanelArea;

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

/// Shows the progress of a background job in the status bar after 0.2 s, with a button that cancels it.
class JobBar : public QWidget {
  Q_OBJECT

 public:
  explicit JobBar(Jobs& jobs);

 private:
  void follow();
  void showShare();

  Jobs& jobs_;
  QLabel* text_;
  QProgressBar* share_;
  QToolButton* cancel_;
  QTimer clock_;
};

/// Bars that come and go, one above the other, over the lower edge of the lowest views. They hide no sentence of a
/// panel, and what is below them does not move, so that the next click hits what it was aimed at.
class BarsOverViews : public QWidget {
  Q_OBJECT

 public:
  /// `area` has a parent, which becomes the parent of the bars too.
  explicit BarsOverViews(PanelArea& area);
  /// Adds a bar below the others. It keeps its own visibility.
  void add(QWidget& bar);

 protected:
  bool event(QEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void place();

  QPointer<PanelArea> area_;  // its panels may still move while it is deleted
  QVBoxLayout* column_;
};

}  // namespace chainmail
