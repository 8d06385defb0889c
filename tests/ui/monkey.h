#pragma once

#include <QTimer>
#include <array>
#include <random>
#include <span>

#include "window.h"
#include "witness.h"

namespace chainmail {

/// A user who knows every control and no restraint. Each event has dice of its own: the same seed does the same, and
/// an event does not depend on how many numbers those before it took.
class Monkey {
 public:
  struct Left {
    const char* action;
    const char* why;
  };
  /// The actions that it keeps its hands off.
  static std::span<const Left> leftAlone();

  /// The folder is the monkey's own.
  Monkey(Workbench& bench, const QString& folder, unsigned seed, const Witness& witness);

  /// The next event.
  void act();
  /// Lets go, and ends what goes on by itself: a test, a report, a film, what is played, relaxation.
  void rest();

 private:
  struct Kind {
    std::size_t weight;
    void (Monkey::*act)();
  };

  std::size_t below(std::size_t n) { return random_() % n; }
  bool once(std::size_t in) { return below(in) == 0; }
  void say(const QString& text);

  // monkey.cpp: the mouse, the keyboard and the window
  void stroke();
  void moveCamera();
  void hover();
  void turnWheel();
  void doubleClick();
  void clickAnywhere();
  void pressKey();
  void resize();
  void wait();
  View& anyView();
  QPointF anywhere(const QWidget& widget);
  void send(QWidget& widget, QEvent::Type type, QPointF place, Qt::MouseButton button, Qt::KeyboardModifiers held = {});
  bool isLeftAlone(const QKeySequence& keys) const;

  // monkey_controls.cpp: what has a name
  void triggerAction();
  void chooseTool();
  void goBackAndForth();
  void pressButton();
  void turnSpin();
  void pullSlider();
  void chooseFromList();
  void arrangeDock();
  void lookAtPass();
  void startSizeTest();
  void startReport();
  void click(const char* button);
  QList<QAction*> actions() const;
  template <class Widget, class Suits>
  Widget* any(const Suits& suits);

  // monkey_files.cpp: meshes, sessions, moves and films, good and bad
  void build();
  void openSomething();
  void saveSomething();
  void writeGarbage();
  QString anyPath();
  void drop(const QString& path);

  Workbench& bench_;
  QString folder_;
  unsigned seed_;
  const Witness& witness_;
  std::mt19937_64 random_;
  std::size_t event_ = 0;
  std::size_t testEnds_ = 0;  // at which event the size test is cancelled, while one runs
  QTimer popups_;             // closes menus and dialogs, which wait for an answer
};

}  // namespace chainmail
