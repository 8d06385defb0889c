#pragma once

#include <QCursor>
#include <QPointF>
#include <QString>
#include <QVector3D>
#include <span>

namespace chainmail {

class View;

/// Handles the left mouse button in the views. One tool is active at a time, for all views.
class Tool {
 public:
  virtual ~Tool() = default;

  virtual QString name() const = 0;
  /// Explains the mouse buttons in the status bar.
  virtual QString hint() const = 0;
  virtual QCursor cursor() const = 0;

  /// Positions are in logical pixels from the top left of the view. hover() is a move without a pressed button.
  virtual void hover(View& view, QPointF position) = 0;
  virtual void press(View& view, QPointF position, Qt::KeyboardModifiers modifiers) = 0;
  virtual void move(View& view, QPointF position, Qt::KeyboardModifiers modifiers) = 0;
  virtual void release(View& view, QPointF position) = 0;
  /// The wheel was turned by this many notches, up if above 0. Returns true if the tool uses it; otherwise it zooms.
  virtual bool wheel(View& /*view*/, QPointF /*position*/, double /*notches*/) { return false; }
  /// The cursor has left the view.
  virtual void leave(View& /*view*/) {}
  /// True if single clicks have an effect. Then a double click counts as two clicks and does not move the camera.
  virtual bool clicks() const { return false; }
  /// True during a stroke or a drag.
  virtual bool busy() const = 0;
  /// Ends the current stroke, which then has no effect, or the current drag. Called by Esc, by undo, and when another
  /// tool is chosen.
  virtual void cancel() = 0;
  /// The tool was chosen, or another one was.
  virtual void setActive(bool /*active*/) {}
  /// Handles Esc, also without a current stroke or drag.
  virtual void escape() { cancel(); }

  /// Returns a line to draw in `view` (logical pixels); empty if the tool is not used in it.
  virtual std::span<const QPointF> stroke(const View& view) const = 0;
  /// Returns the ribbon that a stroke in another view spans with its line of sight: for each point of the stroke a
  /// point before and one behind the object, in the coordinates of frames. Both are in front of the eye.
  virtual std::span<const QVector3D> ribbon(const View& /*view*/) const { return {}; }
};

}  // namespace chainmail
