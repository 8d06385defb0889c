#pragma once

#include <QEventLoop>
#include <QMouseEvent>
#include <QSettings>
#include <QTemporaryDir>
#include <QTimer>
#include <cstdio>
#include <functional>
#include <optional>

#include "bench/metered_application.h"
#include "bench/results.h"
#include "window/startup.h"

namespace chainmail::bench {

// What the programs that measure the real window have in common.

inline MeteredApplication& application() { return *static_cast<MeteredApplication*>(qApp); }

/// Runs the event loop.
inline void run(int milliseconds) {
  QEventLoop loop;
  QTimer::singleShot(milliseconds, Qt::PreciseTimer, &loop, &QEventLoop::quit);
  loop.exec();
}

/// Sends an event of the left mouse button or of the mouse to a view.
inline void send(View& view, QEvent::Type type, QPointF at) {
  const bool moves = type == QEvent::MouseMove;
  QMouseEvent event(type, at, view.mapToGlobal(at), moves ? Qt::NoButton : Qt::LeftButton,
                    type == QEvent::MouseButtonRelease ? Qt::NoButton : Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&view, &event);
}

/// Moves the pointer in a view, without a button.
inline void hover(View& view, QPointF at) {
  QMouseEvent event(QEvent::MouseMove, at, view.mapToGlobal(at), Qt::NoButton, Qt::NoButton, Qt::NoModifier);
  QApplication::sendEvent(&view, &event);
}

/// The main function of such a program. `shows` may do something else instead of measuring, and returns the exit status
/// then.
inline int measureInWindow(int argc, char** argv, const char* program, void (*measure)(Results&),
                           std::optional<int> (*shows)(int argc, char** argv) = nullptr) {
  if (argc < 2) {
    std::fprintf(stderr, "%s: name the file of results, as in: %s build/bench.json\n", program, program);
    return 2;
  }
  prepareApplication();
  const QTemporaryDir settings;
  QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, settings.path());
  MeteredApplication application(argc, argv);
  styleApplication();
  if (const QString why = whyNoWindow(); !why.isEmpty()) {
    std::fprintf(stderr, "%s: %s\n", program, qPrintable(why));
    return 2;
  }
  if (const auto status = shows != nullptr ? shows(argc, argv) : std::nullopt) {
    return *status;
  }
  Results results(argv[1]);
  measure(results);
  results.write();
  return 0;
}

}  // namespace chainmail::bench
