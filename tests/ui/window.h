#pragma once

#include <QApplication>
#include <QSettings>
#include <QTemporaryDir>
#include <QTest>
#include <memory>

#include "main_window.h"
#include "mesh/generate.h"
#include "panel.h"
#include "startup.h"

namespace chainmail {

/// A real workbench for a test, with settings of its own.
struct Workbench {
  explicit Workbench(const MeshPointer& mesh = generate({MeshKind::grid, {9, 7, 1}, 1, {}}))
      : window(mesh, QStringLiteral("sample")) {
    window.show();
    window.activateWindow();  // shortcuts go to the active window
    shown = QTest::qWaitForWindowExposed(&window) && QTest::qWaitForWindowActive(&window);
    settle();
  }

  Document& document() { return window.document(); }
  View& view(int panel) { return window.panel(panel).view(); }

  /// Waits until both solvers have done all that was asked and their frames were drawn.
  void settle() {
    QTest::qWait(30);
    QTRY_VERIFY(window.document().idle());
    QTRY_VERIFY(window.document().frame(0) != nullptr && window.document().frame(1) != nullptr);
    QTest::qWait(60);
  }

  Point position(int panel, ElementId element) { return view(panel).position(element); }
  QPoint place(int panel, ElementId element) { return view(panel).placeOf(element).toPoint(); }

  /// Moves with the left button down, in steps as a hand does; `release` ends the stroke.
  void stroke(int panel, const QList<QPoint>& places, bool release = true) {
    View& at = view(panel);
    QTest::mousePress(&at, Qt::LeftButton, {}, places.first());
    for (qsizetype i = 1; i < places.size(); ++i) {
      for (int step = 1; step <= 5; ++step) {
        QMouseEvent move(QEvent::MouseMove, QPointF(places[i - 1] + (places[i] - places[i - 1]) * step / 5),
                         at.mapToGlobal(QPointF(places[i - 1] + (places[i] - places[i - 1]) * step / 5)), Qt::NoButton,
                         Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(&at, &move);
        QTest::qWait(5);
      }
    }
    if (release) {
      QTest::mouseRelease(&at, Qt::LeftButton, {}, places.last());
      settle();
    }
  }

  void trigger(const char* action) { window.findChild<QAction*>(QLatin1String(action))->trigger(); }
  template <class Widget>
  Widget* find(const char* name) {
    return window.findChild<Widget*>(QLatin1String(name));
  }

  MainWindow window;
  bool shown = false;
};

/// Runs a test class in an application set up as the workbench is; an unexpected warning fails it.
template <class Test>
int runWindowTest(int argc, char** argv) {
  prepareApplication();
  QTemporaryDir settings;
  QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, settings.path());
  QApplication application(argc, argv);
  styleApplication();
  if (const QString why = whyNoWindow(); !why.isEmpty()) {
    qCritical("%s", qPrintable(why));
    return 1;
  }
  Test test;
  return QTest::qExec(&test, argc, argv);
}

/// To be called in init(): from here to the end of the test function a Qt warning is a failure.
inline void failOnWarnings() { QTest::failOnWarning(QRegularExpression(QStringLiteral(".*"))); }

}  // namespace chainmail
