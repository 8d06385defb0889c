// Tests that everything can be reached and done by keyboard and has a name, and that a page lists the keys.

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSpinBox>
#include <QComboBox>
#include <QDockWidget>
#include <QLineEdit>
#include <QMenuBar>
#include <QScrollBar>
#include <QSlider>
#include <QTabBar>
#include <QTest>
#include <QTextBrowser>
#include <QToolBar>

#include "common/actions.h"
#include "window.h"

namespace chainmail::window_keyboard {

namespace {

/// Returns all menus, first the menu bar's own. The menu of recent files has no actions of the window.
QList<QList<QAction*>> menusOf(const QMainWindow& window) {
  QList<QList<QAction*>> menus{window.menuBar()->actions()};
  for (qsizetype i = 0; i < menus.size(); ++i) {
    for (const QAction* action : menus[i]) {
      if (action->menu() != nullptr && !action->text().contains(QStringLiteral("recent"))) {
        menus << action->menu()->actions();
      }
    }
  }
  return menus;
}

QChar mnemonicOf(const QAction& action) {
  const qsizetype at = action.text().indexOf(QLatin1Char('&'));
  return at < 0 ? QChar() : action.text().at(at + 1).toLower();
}

/// Returns the name of a control for a screen reader.
/// Returns the dock, panel or tool bar that contains a control, or the window.
QWidget* partOf(QWidget* control) {
  QWidget* part = control;
  while (!part->isWindow() && qobject_cast<QDockWidget*>(part) == nullptr && qobject_cast<Panel*>(part) == nullptr &&
         qobject_cast<QToolBar*>(part) == nullptr) {
    part = part->parentWidget();
  }
  return part;
}

/// Returns where a control is visible in its window, after scrolling; empty if it is not.
QRect placeOf(const QWidget& control) {
  const QRect whole(control.mapTo(control.window(), QPoint()), control.size());
  return control.isVisible() ? whole.intersected(control.window()->rect()) : QRect();
}

QString nameOf(const QWidget& control, const QWidget& window) {
  if (!control.accessibleName().isEmpty()) {
    return control.accessibleName();
  }
  if (const auto* button = qobject_cast<const QAbstractButton*>(&control)) {
    return button->text();
  }
  for (const QLabel* label : window.findChildren<QLabel*>()) {
    if (label->buddy() == &control) {
      return label->text();
    }
  }
  return {};
}

bool isControl(const QWidget& widget) {
  // Qt names the parts of a control, of a dock's title bar, and of its own menus and bars.
  const QWidget* parent = widget.parentWidget();
  const bool part =
      qobject_cast<const QAbstractSpinBox*>(parent) != nullptr || qobject_cast<const QComboBox*>(parent) != nullptr ||
      qobject_cast<const QLineEdit*>(parent) != nullptr || qobject_cast<const QAbstractItemView*>(parent) != nullptr ||
      qobject_cast<const QTabBar*>(parent) != nullptr || widget.objectName().startsWith(QLatin1String("qt_"));
  return !part && (qobject_cast<const QAbstractButton*>(&widget) != nullptr ||
                   qobject_cast<const QComboBox*>(&widget) != nullptr ||
                   qobject_cast<const QAbstractSpinBox*>(&widget) != nullptr ||
                   qobject_cast<const QSlider*>(&widget) != nullptr ||
                   qobject_cast<const QLineEdit*>(&widget) != nullptr || qobject_cast<const View*>(&widget) != nullptr);
}

QString whatItIs(const QWidget& widget) {
  return QStringLiteral("%1 '%2' in '%3'")
      .arg(QLatin1String(widget.metaObject()->className()), widget.objectName(),
           widget.parentWidget() == nullptr ? QString() : widget.parentWidget()->objectName());
}

}  // namespace

class WindowKeyboard : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

  void anActionIsOneRow() {
    QMainWindow window;
    int done = 0;
    bool isEarly = true, isOn = false, isOnAtFirst = true;
    Actions actions(window, {{"tests", "&Tests"}});
    actions.add("tests",
                {{"act", "&Act…", "fit", "Ctrl+J", "Does it", [&done] { ++done; },
                  When([&isEarly] { return isEarly ? QStringLiteral("Not available: it is too early") : QString(); })},
                 {"turn", "&Turn", "", "", "Turns it", [&isOn](bool on) { isOn = on; }, IsOn([&isOn] { return isOn; })},
                 {"first", "&First", "", "", "Is on at first", [&done](bool) { ++done; },
                  IsOn([&isOnAtFirst] { return isOnAtFirst; })}});
    QAction& act = actions["act"];
    QCOMPARE(actions.menu("tests").actions(), (QList{&act, &actions["turn"], &actions["first"]}));
    QVERIFY(actions["first"].isChecked() && done == 0);  // it was made so, and did nothing
    QVERIFY(!act.isEnabled());
    QCOMPARE(act.statusTip(), QStringLiteral("Not available: it is too early"));
    isEarly = false;
    actions["turn"].trigger();
    QVERIFY(isOn && actions["turn"].isChecked() && act.isEnabled());  // an action evaluates all others
    act.trigger();
    QCOMPARE(done, 1);
    QCOMPARE(act.shortcut(), QKeySequence(QStringLiteral("Ctrl+J")));
    QCOMPARE(act.toolTip(), QStringLiteral("Act (Ctrl+J)\nDoes it"));
  }

  void aTextThatChangesHasALetterWhenItsMenuOpens() {
    QMainWindow window;
    QString name = QStringLiteral("one && two");
    Actions actions(window, {{"tests", "&Tests"}});
    actions.add("tests", {{"act", "&Act", "", "", "", [] {}, Appears([&name] { return Appearance{.text = name}; })}});
    QCOMPARE(plainText(actions["act"]), QStringLiteral("one & two"));
    emit actions.menu("tests").aboutToShow();
    QCOMPARE(actions["act"].text(), QStringLiteral("&one && two"));
    name = QStringLiteral("three");
    emit actions.menu("tests").aboutToShow();
    QCOMPARE(actions["act"].text(), QStringLiteral("&three"));
  }

  void everyActionHasANameAnEffectALetterAndItsOwnKeys() {
    Workbench bench;
    for (const auto& menu : menusOf(bench.window)) {
      QMap<QChar, QString> letters;
      for (const QAction* action : menu) {
        if (action->isSeparator()) {
          continue;
        }
        const QString text = action->text();
        const QChar letter = mnemonicOf(*action);
        QVERIFY2(!letter.isNull(), qPrintable(text + QStringLiteral(": no letter")));
        QVERIFY2(!letters.contains(letter), qPrintable(text + QStringLiteral(" and ") + letters[letter]));
        letters[letter] = text;
        if (action->menu() == nullptr) {
          QVERIFY2(!action->objectName().isEmpty(), qPrintable(text + QStringLiteral(": no name")));
          QVERIFY2(!action->statusTip().isEmpty(), qPrintable(text + QStringLiteral(": no effect")));
        }
      }
    }
    QMap<QKeySequence, QString> keys;
    for (const QAction* action : bench.window.actions()) {
      for (const QKeySequence& one : action->shortcuts()) {
        QVERIFY2(!keys.contains(one), qPrintable(action->text() + QStringLiteral(" and ") + keys[one]));
        keys[one] = action->text();
      }
    }
    // Tool tips name the keys.
    QVERIFY(bench.find<QAction>("fitView")->toolTip().startsWith(QStringLiteral("Fit view (F)\nShows")));
  }

  void everyControlHasANameAndSaysWhatItDoes() {
    Workbench bench;
    for (const QWidget* widget : bench.window.findChildren<QWidget*>()) {
      if (isControl(*widget)) {
        QVERIFY2(!nameOf(*widget, bench.window).isEmpty(), qPrintable(whatItIs(*widget)));
        const bool isView = qobject_cast<const View*>(widget) != nullptr;  // a tool tip would cover the object
        QVERIFY2(isView || !widget->toolTip().isEmpty(), qPrintable(whatItIs(*widget)));
      }
    }
  }

  void tabGoesThroughTheDocksAndBothViews() {
    Workbench bench;
    bench.view(0).setFocus();
    QSet<QString> reached;
    for (int i = 0; i < 120; ++i) {
      QTest::keyClick(QApplication::focusWidget(), Qt::Key_Tab);
      reached += QApplication::focusWidget()->objectName();
    }
    for (const char* name : {"view0", "view1", "algorithm0", "algorithm1", "colourBy", "meshKind", "buildMesh",
                             "compressionSpin", "compressionSlider", "relaxationOn"}) {
      QVERIFY2(reached.contains(QLatin1String(name)), name);
    }
  }

  /// Each press of Tab shows the focus at another place, further down or to the right, and a dock or a panel is left
  /// only when all of it was reached.
  void tabStopsOnceAtEachControlInTheOrderOfTheScreen() {
    Workbench bench;
    bench.view(0).setFocus();
    QSet<QWidget*> stops, left;
    QWidget* before = QApplication::focusWidget();
    const QWidget* first = partOf(before);
    do {
      QTest::keyClick(before, Qt::Key_Tab);
      QWidget* now = QApplication::focusWidget();
      const QString step = whatItIs(*before) + QStringLiteral(" > ") + whatItIs(*now);
      QVERIFY2(!stops.contains(now) && !placeOf(*now).isEmpty(), qPrintable(step));
      stops += now;
      if (partOf(now) == partOf(before)) {
        QVERIFY2(placeOf(*now).bottom() > placeOf(*before).top(), qPrintable(step));
      } else {
        left += partOf(before);
        QVERIFY2(!left.contains(partOf(now)) || partOf(now) == first, qPrintable(step));
      }
      before = now;
    } while (before != &bench.view(0));
  }

  void keysMoveTheCameraOfTheViewThatHasThem() {
    Workbench bench;  // an object in 2D: arrow keys pan
    bench.view(1).setFocus(Qt::TabFocusReason);
    const auto middle = [&bench] { return bench.view(1).viewPosition(ElementId(31)); };
    const QPointF before = middle();
    QTest::keyClick(&bench.view(1), Qt::Key_Right);
    QVERIFY(middle().x() > before.x());
    QVERIFY(std::abs(middle().y() - before.y()) < 0.01);  // positions are in single precision
    QTest::keyClick(&bench.view(1), Qt::Key_Left);
    QVERIFY((middle() - before).manhattanLength() < 0.01);
    const int across = bench.place(1, 8).x() - bench.place(1, 0).x();
    QTest::keyClick(&bench.view(1), Qt::Key_Plus);
    QVERIFY(bench.place(1, 8).x() - bench.place(1, 0).x() > across);
    QTest::keyClick(&bench.view(1), Qt::Key_Minus);
    QCOMPARE(bench.place(1, 8).x() - bench.place(1, 0).x(), across);
  }

  void arrowsStayWithTheFieldThatHasThem() {
    Workbench bench;
    const QPoint before = bench.place(0, 31);
    auto* slider = bench.find<QSlider>("compressionSlider");
    slider->setFocus();
    const int value = slider->value();
    QTest::keyClick(slider, Qt::Key_Left);
    QVERIFY(slider->value() < value);
    QCOMPARE(bench.place(0, 31), before);
  }

  void onePageListsTheKeysThatExist() {
    Workbench bench;
    QTest::keyClick(&bench.window, Qt::Key_F1);
    auto* page = bench.find<QWidget>("keysPage");
    QVERIFY(page->isVisible());
    auto* text = page->findChild<QTextBrowser*>();
    QStringList rows = text->toPlainText().split(QLatin1Char('\n'), Qt::SkipEmptyParts);
    int listed = 0;
    for (const QAction* action : bench.window.actions()) {
      const QString name = QString(action->text()).remove(QLatin1Char('&')).remove(QStringLiteral("…"));
      const QString keys = action->shortcut().toString(QKeySequence::NativeText);
      bool isListed = keys.isEmpty();
      for (qsizetype row = 1; row < rows.size(); ++row) {  // several actions may have one name
        isListed = isListed || (rows[row] == name && rows[row - 1].contains(keys));
      }
      QVERIFY2(isListed, qPrintable(name));
      listed += action->shortcut().isEmpty() ? 0 : 1;
    }
    QVERIFY(listed > 40);
    QVERIFY(page->screen()->availableGeometry().contains(page->frameGeometry()));
    QCOMPARE(text->horizontalScrollBar()->maximum(), 0);
    QVERIFY(QTest::qWaitForWindowActive(page));  // or Escape is for the window below
    QTest::keyClick(text, Qt::Key_Escape);
    QVERIFY(!page->isVisible());
  }
};

CHAINMAIL_WINDOW_TEST(WindowKeyboard)

}  // namespace chainmail::window_keyboard

#include "window_keyboard.moc"
