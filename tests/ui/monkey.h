#pragma once

#include <QTimer>
#include <array>
#include <random>
#include <span>

#include "window.h"
#include "witness.h"

namespace chainmail {

/// A simulated user who uses every control, in any order. Each event has its own random numbers: the same seed gives
/// the same events, and an event does not depend on how many random numbers earlier events used.
class Monkey {
 public:
  struct Left {
    const char* action;
    const char* why;
  };
  /// Returns the actions that it never triggers.
  static std::span<const Left> leftAlone();

  /// `folder` must be for the monkey only.
  Monkey(Workbench& bench, const QString& folder, unsigned seed, const Witness& witness);

  /// Performs the next event.
  void act();
  /// Releases the handle and ends what still runs: report, film, playback, relaxation.
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

  // monkey_controls.cpp: widgets and actions with names
  void triggerAction();
  void chooseTool();
  void goBackAndForth();
  void pressButton();
  void turnSpin();
  void pullSlider();
  void chooseFromList();
  void arrangeDock();
  void lookAtPass();
  void startReport();
  void click(const char* button);
  QList<QAction*> actions() const;
  template <class Widget, class Suits>
  Widget* any(const Suits& suits);

  // monkey_files.cpp: valid and invalid meshes, sessions, moves and films
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
  QTimer popups_;  // closes menus and dialogs, which would wait for an answer
};

}  // namespace chainmail
