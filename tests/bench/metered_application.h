#pragma once

#include <QApplication>
#include <QByteArray>
#include <QEvent>
#include <QMetaEnum>
#include <QSet>
#include <algorithm>

#include "bench/process.h"
#include "panels/view.h"

namespace chainmail::bench {

/// Sees every event that Qt delivers, and measures the time for drawing apart from the rest. Drawing is an update of
/// the window (UpdateRequest), in which Qt paints the widgets, the views draw and the picture is composed, and a
/// request of the window system (Expose). The remaining time is the GUI's own work: input, received frames, timers,
/// figures.
class MeteredApplication : public QApplication {
 public:
  using QApplication::QApplication;

  bool notify(QObject* receiver, QEvent* event) override {
    const QEvent::Type type = event->type();
    if (type == QEvent::Paint && qobject_cast<View*>(receiver) != nullptr) {
      painted_ = true;
      ++viewPaints;
      viewsPainted.insert(receiver);
    }
    if (drawing_) {
      return QApplication::notify(receiver, event);
    }
    if (type != QEvent::UpdateRequest && type != QEvent::Expose && type != QEvent::Paint) {
      return note(receiver, event);
    }
    drawing_ = true;
    painted_ = false;
    const double before = cpu_milliseconds(CLOCK_THREAD_CPUTIME_ID);
    const bool handled = QApplication::notify(receiver, event);
    const double drew = cpu_milliseconds(CLOCK_THREAD_CPUTIME_ID) - before;
    drawingMilliseconds += drew;
    longestDrawing = std::max(longestDrawing, drew);
    drawing_ = false;
    framesDrawn += painted_ ? 1 : 0;
    return handled;
  }

  double drawingMilliseconds = 0;  // processor time of this thread
  double longestMilliseconds = 0;  // of an event without drawing, since it was set to 0
  QByteArray longestEvent;         // its type
  double longestDrawing = 0;       // ms, since it was set to 0
  int framesDrawn = 0;             // updates of the window that drew at least one view
  int viewPaints = 0;
  QSet<const QObject*> viewsPainted;

 private:
  /// Delivers an event that draws nothing itself.
  bool note(QObject* receiver, QEvent* event) {
    const double before = cpu_milliseconds(CLOCK_THREAD_CPUTIME_ID), drawn = drawingMilliseconds;
    const bool handled = QApplication::notify(receiver, event);
    const double own = cpu_milliseconds(CLOCK_THREAD_CPUTIME_ID) - before - (drawingMilliseconds - drawn);
    if (own > longestMilliseconds) {
      longestMilliseconds = own;
      longestEvent = QMetaEnum::fromType<QEvent::Type>().valueToKey(event->type());
    }
    return handled;
  }

  bool drawing_ = false;
  bool painted_ = false;
};

}  // namespace chainmail::bench
