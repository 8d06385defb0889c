#pragma once

#include <QCursor>
#include <QPointF>
#include <QString>
#include <span>

namespace chainmail {

class View;

/// What the left mouse button does in a view. One tool is active at a time, for all views.
class Tool {
 public:
  virtual ~Tool() = default;

  virtual QString name() const = 0;
  /// What the buttons do, for the status bar.
  virtual QString hint() const = 0;
  virtual QCursor cursor() const = 0;

  /// Places are in logical pixels from the view's top left. `hover` is a move without a button.
  virtual void hover(View& view, QPointF place) = 0;
  virtual void press(View& view, QPointF place, Qt::KeyboardModifiers modifiers) = 0;
  virtual void move(View& view, QPointF place) = 0;
  virtual void release(View& view, QPointF place) = 0;
  /// The cursor has left the view.
  virtual void leave(View& /*view*/) {}
  /// Whether a click does something: then a double click is two of them, and does not move the camera.
  virtual bool clicks() const { return false; }
  /// Whether a stroke or a drag is under way.
  virtual bool busy() const = 0;
  /// Esc, another tool, an undo: gives up what was begun and leaves nothing behind.
  virtual void cancel() = 0;
  /// Esc where there may be nothing to give up.
  virtual void escape() { cancel(); }

  /// A line to draw in the view where the tool is at work (logical pixels).
  virtual std::span<const QPointF> stroke(const View& view) const = 0;
};

}  // namespace chainmail
