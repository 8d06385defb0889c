// Events for widgets with names: actions, buttons, fields, docks.

#include <QAbstractButton>
#include <QAbstractSpinBox>
#include <QComboBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QSlider>
#include <QSpinBox>
#include <QToolButton>
#include <algorithm>

#include "document/edits.h"
#include "monkey.h"

namespace chainmail {
namespace {

constexpr const char* asks = "asks where, in a file dialog that waits for an answer";
constexpr std::array left{Monkey::Left{"openFile", asks},
                          Monkey::Left{"saveSession", "asks where, as long as the session has no file"},
                          Monkey::Left{"saveSessionAs", asks},
                          Monkey::Left{"saveFile", asks},
                          Monkey::Left{"saveShapeA", asks},
                          Monkey::Left{"saveShapeB", asks},
                          Monkey::Left{"saveShapeC", asks},
                          Monkey::Left{"saveShapeD", asks},
                          Monkey::Left{"savePicture", asks},
                          Monkey::Left{"saveRateTable", asks},
                          Monkey::Left{"saveRatePicture", asks},
                          Monkey::Left{"openMoves", asks},
                          Monkey::Left{"saveMoves", asks},
                          Monkey::Left{"exportFilm", "asks where, and runs another program"},
                          Monkey::Left{"pictureOwnSize", "asks for a size, in a dialog that waits for an answer"},
                          Monkey::Left{"quit", "closes the window"}};

bool isLeft(const QAction& action) {
  return std::ranges::any_of(left, [&](const auto& one) { return action.objectName() == QLatin1String(one.action); });
}

/// Returns a name that is unique for a widget and the same in each run.
QString nameOf(const QWidget& widget) {
  QString name = widget.objectName().isEmpty() ? QLatin1String(widget.metaObject()->className()) : widget.objectName();
  if (const auto* button = qobject_cast<const QAbstractButton*>(&widget)) {
    name += button->text();
  }
  return widget.parentWidget() == nullptr || !widget.objectName().isEmpty()
             ? name
             : nameOf(*widget.parentWidget()) + QLatin1Char('/') + name;
}

}  // namespace

std::span<const Monkey::Left> Monkey::leftAlone() { return left; }

/// Returns a random widget that a user could reach now. The choice depends on names only, so that one visible widget
/// more or less does not change other choices.
template <class Widget, class Suits>
Widget* Monkey::any(const Suits& suits) {
  Widget* chosen = nullptr;
  std::size_t highest = 0;
  const std::size_t salt = random_();
  for (Widget* one : bench_.window.findChildren<Widget*>()) {
    if (one->isVisible() && one->isEnabled() && suits(*one)) {
      if (const std::size_t rank = qHash(nameOf(*one), salt); chosen == nullptr || rank > highest) {
        chosen = one;
        highest = rank;
      }
    }
  }
  if (chosen == nullptr) {
    say(QStringLiteral("nothing of this kind is in sight"));
  }
  return chosen;
}

QList<QAction*> Monkey::actions() const {
  QList<QAction*> named;
  for (QAction* action : bench_.window.findChildren<QAction*>()) {
    const QString name = action->objectName();
    if (!name.isEmpty() && !name.startsWith(QLatin1String("_q_")) && !isLeft(*action)) {
      named << action;
    }
  }
  return named;
}

void Monkey::triggerAction() {
  const auto all = actions();
  QAction* action = all[qsizetype(below(std::size_t(all.size())))];
  say(QStringLiteral("action %1%2")
          .arg(action->objectName(), action->isEnabled() && action->isVisible() ? QString() : QStringLiteral(", off")));
  if (action->isEnabled() && action->isVisible()) {
    action->trigger();
  }
}

void Monkey::chooseTool() {
  static constexpr std::array tools{"toolDrag", "toolCut", "toolPin", "toolSelect", "toolMeasure", "toolDrag"};
  const char* tool = tools[below(tools.size())];
  say(QLatin1String(tool));
  if (auto* action = bench_.window.findChild<QAction*>(QLatin1String(tool)); action->isEnabled()) {
    action->trigger();
  }
}

void Monkey::goBackAndForth() {
  for (std::size_t i = below(4); i > 0; --i) {
    const char* way = once(3) ? "redo" : "undo";
    say(QLatin1String(way));
    bench_.trigger(way);
  }
}

/// Leaves out buttons that ask for a file (their text ends in an ellipsis), and buttons that start something with
/// fields of any size.
void Monkey::pressButton() {
  auto* button = any<QAbstractButton>([](const QAbstractButton& one) {
    const auto* tool = qobject_cast<const QToolButton*>(&one);
    const bool asksWhere = tool != nullptr && tool->defaultAction() != nullptr && isLeft(*tool->defaultAction());
    return !asksWhere && !one.text().endsWith(QChar(0x2026)) && one.objectName() != QLatin1String("buildMesh");
  });
  if (button != nullptr) {
    say(QStringLiteral("button %1").arg(nameOf(*button)));
    button->click();
  }
}

/// Chooses a value near the minimum, because large values would only take long.
void Monkey::turnSpin() {
  auto* field = any<QAbstractSpinBox>([](const QAbstractSpinBox& one) { return !one.isReadOnly(); });
  const std::size_t drawn = below(13);
  if (auto* spin = qobject_cast<QSpinBox*>(field)) {
    say(QStringLiteral("spin box %1").arg(nameOf(*spin)));
    spin->setValue(spin->minimum() + int(drawn));
  } else if (auto* real = qobject_cast<QDoubleSpinBox*>(field)) {
    const double range = std::min(100.0, real->maximum() - std::max(-50.0, real->minimum()));
    say(QStringLiteral("spin box %1").arg(nameOf(*real)));
    real->setValue(std::max(-50.0, real->minimum()) + range * double(drawn) / 12);
  }
}

/// Sets a value directly, or by moving the slider's handle.
void Monkey::pullSlider() {
  auto* slider = any<QSlider>([](const QSlider& one) { return one.maximum() > one.minimum(); });
  if (slider == nullptr) {
    return;
  }
  say(QStringLiteral("slider %1").arg(nameOf(*slider)));
  const int range = slider->maximum() - slider->minimum();
  const QPointer<QSlider> still = slider;
  slider->setSliderDown(true);
  for (std::size_t i = 1 + below(3); i > 0 && still; --i) {
    slider->setSliderPosition(slider->minimum() + int(below(std::size_t(range) + 1)));
    if (once(3)) {
      QCoreApplication::processEvents();
    }
  }
  if (still) {
    slider->setSliderDown(false);
  }
}

void Monkey::chooseFromList() {
  auto* list = any<QComboBox>([](const QComboBox& one) { return one.count() > 0; });
  if (list != nullptr) {
    const int item = int(below(std::size_t(list->count())));
    const bool can = list->model()->index(item, 0).flags().testFlag(Qt::ItemIsEnabled);
    say(QStringLiteral("list %1: '%2'%3")
            .arg(nameOf(*list), list->itemText(item), can ? QString() : QStringLiteral(", off")));
    if (can) {
      list->setCurrentIndex(item);
      emit list->activated(item);
    }
  }
}

void Monkey::arrangeDock() {
  const auto docks = bench_.window.findChildren<QDockWidget*>();
  QDockWidget* dock = docks[qsizetype(below(std::size_t(docks.size())))];
  static constexpr std::array areas{Qt::LeftDockWidgetArea, Qt::RightDockWidgetArea, Qt::BottomDockWidgetArea};
  const std::size_t what = below(6);
  say(QStringLiteral("dock %1: %2").arg(dock->objectName()).arg(what));
  if (what == 0) {
    dock->setFloating(!dock->isFloating());
  } else if (what == 1) {
    bench_.window.addDockWidget(areas[below(areas.size())], dock);
  } else if (what == 2) {
    dock->close();
  } else {
    dock->toggleViewAction()->trigger();
  }
}

void Monkey::lookAtPass() {
  static constexpr std::array steps{"passFirst", "passBack", "passForward", "passLast", "passPlay", "passFollow"};
  auto* show = bench_.window.findChild<QAction*>(QStringLiteral("showPropagation"));
  const char* step = steps[below(steps.size())];
  say(QStringLiteral("look at a pass: %1").arg(QLatin1String(show->isChecked() ? step : "showPropagation")));
  auto* action = show->isChecked() ? bench_.window.findChild<QAction*>(QLatin1String(step)) : show;
  if (action->isEnabled()) {
    action->trigger();
  }
}

void Monkey::click(const char* button) { bench_.find<QAbstractButton>(button)->click(); }

void Monkey::startReport() {
  if (auto* show = bench_.window.findChild<QAction*>(QStringLiteral("showReport"));
      show->isEnabled() && !show->isChecked()) {
    show->trigger();
  }
  say(QStringLiteral("report"));
  click("reportRun");
}

void Monkey::rest() {
  say(QStringLiteral("rest"));
  QTest::keyClick(&bench_.window, Qt::Key_Escape);
  click("reportCancel");
  auto* play = bench_.window.findChild<QAction*>(QStringLiteral("replayPlay"));
  if (play->text().contains(QLatin1String("Pause"))) {
    play->trigger();
  }
  if (auto* show = bench_.window.findChild<QAction*>(QStringLiteral("showPropagation")); show->isChecked()) {
    show->trigger();  // while a pass is shown, the views do not show the current positions
  }
  bench_.trigger("toolDrag");  // releases the handle
  bench_.settle();
  commands::SetRelaxation off = bench_.document().relaxation();
  off.on = false;
  edits::setRelaxation(bench_.document(), off);
  bench_.settle();
}

}  // namespace chainmail
