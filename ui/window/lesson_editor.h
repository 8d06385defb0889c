#pragma once

#include <QWidget>
#include <functional>

#include "document/lesson_player.h"
#include "document/lesson_writer.h"

class QAction;
class QLineEdit;
class QMenu;
class QPlainTextEdit;

namespace chainmail {

/// The fields and buttons that write a lesson: its title, and title and caption of the present step. It is a part of
/// the lesson bar, and visible while the user writes.
class LessonEditor : public QWidget {
  Q_OBJECT

 public:
  /// `look` returns what the window shows now, in the names of a step.
  LessonEditor(Document& document, const LessonPlayer& player, std::function<LessonStep()> look);

  /// Makes a lesson from the recorded moves, for menus.
  QAction& newLesson() { return *new_; }
  /// Adds the actions that begin to write.
  void fill(QMenu& menu);
  bool isEditing() const;
  /// Ends writing. The lesson stays as it is.
  void stop();

 signals:
  void editingChanged();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  QAction* add(const char* name, const QString& text, const char* drawing, const QString& help);
  void arrange();
  void listen();
  void begin();
  void refresh();
  void refreshActions();
  void showTexts();

  const LessonPlayer& player_;
  LessonWriter writer_;
  std::function<LessonStep()> look_;
  QAction *new_, *edit_, *addStep_, *remove_, *earlier_, *later_;
  QLineEdit *lessonTitle_, *title_;
  QPlainTextEdit* text_;
};

}  // namespace chainmail
