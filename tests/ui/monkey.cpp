#include "monkey.h"

#include <QAbstractButton>
#include <QSignalSpy>
#include <QWheelEvent>
#include <algorithm>
#include <numeric>

namespace chainmail {

Monkey::Monkey(Workbench& bench, const QString& folder, unsigned seed, const Witness& witness)
    : bench_(bench), folder_(folder), seed_(seed), witness_(witness) {
  bench_.window.resize(640, 400);  // a small window takes less time to paint, so more events fit in
  QObject::connect(&popups_, &QTimer::timeout, &bench_.window, [] {
    if (QWidget* popup = QApplication::activePopupWidget()) {
      popup->close();
    } else if (QWidget* dialog = QApplication::activeModalWidget()) {
      dialog->close();
    }
  });
  popups_.start(10);
}

void Monkey::act() {
  static constexpr std::array kinds{
      Kind{14, &Monkey::stroke},        Kind{3, &Monkey::moveCamera},  Kind{3, &Monkey::hover},
      Kind{3, &Monkey::turnWheel},      Kind{2, &Monkey::doubleClick}, Kind{6, &Monkey::clickAnywhere},
      Kind{9, &Monkey::pressKey},       Kind{2, &Monkey::resize},      Kind{4, &Monkey::wait},
      Kind{14, &Monkey::triggerAction}, Kind{5, &Monkey::chooseTool},  Kind{7, &Monkey::goBackAndForth},
      Kind{6, &Monkey::pressButton},    Kind{4, &Monkey::turnSpin},    Kind{5, &Monkey::pullSlider},
      Kind{5, &Monkey::chooseFromList}, Kind{4, &Monkey::arrangeDock}, Kind{3, &Monkey::lookAtPass},
      Kind{1, &Monkey::startReport},    Kind{3, &Monkey::build},       Kind{4, &Monkey::openSomething},
      Kind{3, &Monkey::saveSomething}};
  static constexpr std::size_t all = std::accumulate(kinds.begin(), kinds.end(), std::size_t(0),
                                                     [](auto sum, auto& kind) { return sum + kind.weight; });
  random_.seed(seed_ * 1'000'003ULL + ++event_);
  std::size_t drawn = below(all);
  const auto* kind = kinds.begin();
  for (; drawn >= kind->weight; ++kind) {
    drawn -= kind->weight;
  }
  (this->*kind->act)();
  if (!once(4)) {
    QCoreApplication::processEvents();
  }
}

void Monkey::say(const QString& text) {
  witness_.tell(QStringLiteral("seed %1, event %2: %3").arg(seed_).arg(event_).arg(text).toStdString());
}

View& Monkey::anyView() { return bench_.view(int(below(std::size_t(bench_.document().panels())))); }

QPointF Monkey::anywhere(const QWidget& widget) {
  const auto along = [this](int length) { return double(below(std::size_t(std::max(1, length)))); };
  const double x = along(widget.width());
  return {x, along(widget.height())};
}

void Monkey::send(QWidget& widget, QEvent::Type type, QPointF place, Qt::MouseButton button,
                  Qt::KeyboardModifiers held) {
  QMouseEvent event(type, place, widget.mapToGlobal(place), type == QEvent::MouseMove ? Qt::NoButton : button,
                    type == QEvent::MouseButtonRelease ? Qt::NoButton : button, held);
  QApplication::sendEvent(&widget, &event);
}

/// Drags from an element to random positions. Sometimes it cancels the stroke, undoes in the middle, or never releases.
void Monkey::stroke() {
  View& view = anyView();
  const auto element = ElementId(below(bench_.document().mesh()->element_count()));
  const auto held = once(4) ? Qt::ShiftModifier : once(8) ? Qt::ControlModifier : Qt::NoModifier;
  say(QStringLiteral("stroke in %1 from element %2").arg(view.objectName()).arg(element));
  send(view, QEvent::MouseButtonPress, once(6) ? anywhere(view) : view.viewPosition(element), Qt::LeftButton, held);
  const QPointer<View> still = &view;  // a session that opens meanwhile may have fewer panels
  for (std::size_t i = below(6); i > 0 && still; --i) {
    send(view, QEvent::MouseMove, anywhere(view), Qt::LeftButton, held);
    if (once(25)) {
      say(QStringLiteral("  Escape in its middle"));
      QTest::keyClick(&bench_.window, Qt::Key_Escape);
    } else if (once(25)) {
      goBackAndForth();
    } else if (once(3)) {
      QCoreApplication::processEvents();
    }
  }
  if (!once(12) && still) {
    send(view, QEvent::MouseButtonRelease, anywhere(view), Qt::LeftButton);
  }
}

void Monkey::moveCamera() {
  View& view = anyView();
  const auto button = once(2) ? Qt::RightButton : Qt::MiddleButton;
  say(QStringLiteral("camera of %1").arg(view.objectName()));
  send(view, QEvent::MouseButtonPress, anywhere(view), button);
  send(view, QEvent::MouseMove, anywhere(view), button);
  send(view, QEvent::MouseButtonRelease, anywhere(view), button);
}

void Monkey::hover() {
  View& view = anyView();
  say(QStringLiteral("hover over %1").arg(view.objectName()));
  send(view, QEvent::MouseMove, anywhere(view), Qt::NoButton);
  if (once(3)) {
    // The element below the cursor is searched in idle time.
    (void)QTest::qWaitFor([this] { return bench_.timersOfUpdates(Workbench::shortly).isEmpty(); }, 100);
  } else if (once(3)) {
    QEvent leave(QEvent::Leave);
    QApplication::sendEvent(&view, &leave);
  }
}

void Monkey::turnWheel() {
  View& view = anyView();
  const QPointF at = anywhere(view);
  const int angle = (once(2) ? 120 : -120) * (once(10) ? 100 : 1);
  say(QStringLiteral("wheel by %1 in %2").arg(angle).arg(view.objectName()));
  QWheelEvent wheel(at, view.mapToGlobal(at), {}, {0, angle}, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
  QApplication::sendEvent(&view, &wheel);
}

void Monkey::doubleClick() {
  QWidget& widget = once(3) ? static_cast<QWidget&>(bench_.window.panel(0).head()) : anyView();
  const QPointF at = anywhere(widget);
  say(QStringLiteral("double click in %1").arg(QLatin1String(widget.metaObject()->className())));
  for (const auto type : {QEvent::MouseButtonPress, QEvent::MouseButtonRelease, QEvent::MouseButtonDblClick,
                          QEvent::MouseButtonRelease}) {
    send(widget, type, at, Qt::LeftButton);
  }
}

/// Clicks on any widget: a list, a table, a tab, a plot, a handle, the title of a dock.
void Monkey::clickAnywhere() {
  const QPointF at = anywhere(bench_.window);
  QWidget* there = bench_.window.childAt(at.toPoint());
  if (there == nullptr || qobject_cast<QAbstractButton*>(there) != nullptr) {
    say(QStringLiteral("nothing to click at"));
    return;  // buttons have a separate event
  }
  say(QStringLiteral("click at %1 '%2'").arg(QLatin1String(there->metaObject()->className()), there->objectName()));
  const QPointF place = there->mapFrom(&bench_.window, at);
  const auto button = once(5) ? Qt::RightButton : Qt::LeftButton;
  const QPointer<QWidget> still = there;
  send(*there, QEvent::MouseButtonPress, place, button);
  if (still && once(3)) {
    send(*still, QEvent::MouseMove, place + QPointF(double(below(60)) - 30, double(below(60)) - 30), button);
  }
  if (still) {
    send(*still, QEvent::MouseButtonRelease, place, button);
  }
}

bool Monkey::isLeftAlone(const QKeySequence& keys) const {
  return std::ranges::any_of(leftAlone(), [&](const Left& left) {
    const auto* action = bench_.window.findChild<QAction*>(QLatin1String(left.action));
    return action != nullptr && action->shortcuts().contains(keys);
  });
}

/// Presses no digits: in the size of a mesh, they would only take time.
void Monkey::pressKey() {
  static constexpr std::array others{Qt::Key_Escape,   Qt::Key_Tab,   Qt::Key_Backtab, Qt::Key_Left,     Qt::Key_Right,
                                     Qt::Key_Up,       Qt::Key_Down,  Qt::Key_Return,  Qt::Key_Space,    Qt::Key_Delete,
                                     Qt::Key_Home,     Qt::Key_End,   Qt::Key_PageUp,  Qt::Key_PageDown, Qt::Key_Plus,
                                     Qt::Key_Minus,    Qt::Key_Comma, Qt::Key_Period,  Qt::Key_Escape,   Qt::Key_F1,
                                     Qt::Key_Backspace};
  static constexpr std::array<Qt::KeyboardModifiers, 8> modifiers{
      Qt::NoModifier,    Qt::NoModifier,      Qt::NoModifier,  Qt::NoModifier,
      Qt::ShiftModifier, Qt::ControlModifier, Qt::AltModifier, Qt::ControlModifier | Qt::AltModifier};
  const Qt::Key key = once(2) ? Qt::Key(Qt::Key_A + int(below(26))) : others[below(others.size())];
  const Qt::KeyboardModifiers held = modifiers[below(modifiers.size())];
  QWidget* target = QApplication::focusWidget();
  if (target == nullptr || once(3)) {
    target = &bench_.window;
  }
  const QKeySequence keys(QKeyCombination(held, key));
  if (isLeftAlone(keys)) {
    say(QStringLiteral("leave the keys of a dialog alone"));
    return;
  }
  say(QStringLiteral("press %1 in %2 '%3'")
          .arg(keys.toString(), QLatin1String(target->metaObject()->className()), target->objectName()));
  QTest::keyClick(target, key, held);
}

void Monkey::resize() {
  const QSize size(500 + int(below(500)), 300 + int(below(400)));
  say(QStringLiteral("resize to %1 × %2").arg(size.width()).arg(size.height()));
  bench_.window.resize(size);
}

void Monkey::wait() {
  const int milliseconds = int(below(40));
  say(QStringLiteral("wait for a frame, %1 ms at most").arg(milliseconds));
  QSignalSpy(&bench_.document().solvers(), &PanelSolvers::frameReady).wait(milliseconds);
}

}  // namespace chainmail
