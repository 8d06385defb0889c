#pragma once

#include <QObject>
#include <optional>

#include "document/lesson_player.h"
#include "panels/colouring.h"
#include "panels/overlay.h"

class QDockWidget;

namespace chainmail {

class Actions;
class LessonBar;
class MainWindow;
class Sessions;
struct LessonFile;

/// Marks the handles that a lesson has dragged, as the Drag tool marks its handle.
class LessonHandle : public Overlay {
 public:
  explicit LessonHandle(const LessonPlayer& player) : player_(player) {}

  void draw(const Canvas& canvas) override;

 private:
  const LessonPlayer& player_;
};

/// The lessons of a window: the menu that opens them, their bar, and what the window shows at each step.
class Lessons : public QObject {
  Q_OBJECT

 public:
  Lessons(MainWindow& window, Propagation& propagation, const Sessions& sessions, Actions& actions);

  /// Returns the bar. The window places and owns it.
  LessonBar& bar() { return *bar_; }
  LessonPlayer& player() { return player_; }

 private:
  void open(const char* file);
  void openFollowing();
  const LessonFile* neighbour(int steps) const;
  void goOn();
  void goBack();
  void addActions();
  void start();
  void leave();
  void showStep();
  void fitBefore();
  void fitAfter(bool playedOneByOne);
  void warnOfUnknownNames();
  QString nameOf(std::string LessonStep::*which) const;
  void chooseDock(const QString& name);
  QDockWidget* dock(const QString& name) const;

  MainWindow& window_;
  LessonPlayer player_;
  Actions& actions_;
  LessonHandle handle_;
  bool opensAtEnd_ = false;  // true while a lesson is opened to show its last step
  LessonBar* bar_;
  QString dock_;                            // name of the dock that the lesson has opened
  std::optional<ColourMode> colourBefore_;  // what coloured the object before the lesson
};

}  // namespace chainmail
