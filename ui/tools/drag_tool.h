#pragma once

#include <QObject>
#include <QPointer>
#include <QVector3D>
#include <cstddef>
#include <optional>
#include <vector>

#include "document/document.h"
#include "panels/tool.h"
#include "tools/rotation_ring.h"

namespace chainmail {

/// The brush of the Drag tool: a press grabs all elements within its radius. The wheel changes the radius while `R` is
/// held. Without a radius, a press grabs one element.
class GrabBrush : public QObject {
  Q_OBJECT

 public:
  static constexpr double largestRadius = 300;  // logical pixels

  GrabBrush();
  ~GrabBrush() override;

  /// Returns the radius (logical pixels); 0 for one element.
  int radius() const;
  bool keyHeld() const { return keyHeld_; }
  /// Changes the radius by notches of the wheel.
  void turn(double notches);
  void setNotches(double notches);
  /// Number of elements that a press would grab.
  std::size_t reached() const { return reached_; }
  void setReached(std::size_t elements);

 signals:
  /// The radius or the number of elements has changed.
  void changed();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  double notches_ = 0;  // of the wheel, since the radius was 0
  std::size_t reached_ = 0;
  bool keyHeld_ = false;
};

/// Grabs a handle and moves it in all panels, in the plane through the handle that is parallel to the view: the element
/// under the cursor, the selection that this element belongs to, or all elements within the brush. A handle of many
/// elements rotates about the axis across the view while Shift is held, or when the user drags the rotation ring.
class DragTool : public Tool {
 public:
  DragTool(Document& document, GrabBrush& brush, RotationRing& ring)
      : document_(document), brush_(brush), ring_(ring) {}

  QString name() const override { return QStringLiteral("Drag"); }
  QString hint() const override;
  QCursor cursor() const override { return Qt::ArrowCursor; }

  void hover(View& view, QPointF position) override;
  void press(View& view, QPointF position, Qt::KeyboardModifiers modifiers) override;
  void move(View& view, QPointF position, Qt::KeyboardModifiers modifiers) override;
  void release(View& view, QPointF position) override;
  void leave(View& view) override;
  bool wheel(View& view, QPointF position, double notches) override;
  bool busy() const override { return grip_ != Grip::nothing; }
  void cancel() override;
  void escape() override;
  void setActive(bool active) override { ring_.setActive(active); }
  std::span<const QPointF> stroke(const View& view) const override;

 private:
  enum class Grip { nothing, element, handle, ring };
  /// The motion of a handle of many elements since it was grabbed (mesh units).
  struct Motion {
    Point pivot = Point::Zero();  // when it was grabbed
    Point by = Point::Zero();
    Rotation rotation;
    // Since it changed between translation and rotation.
    bool turns = false;
    Point byBefore = Point::Zero();
    Rotation rotationBefore;
    Point axis = Point::Zero();   // towards the eye
    double turned = 0;            // degrees
    std::optional<double> angle;  // of the cursor about the pivot (degrees); none near the pivot
    QPointF cursor;               // its last position
  };

  void grab(View& view, QPointF position, const std::vector<ElementId>& elements, Grip grip);
  std::vector<ElementId> elementsToGrab(View& view, QPointF position) const;
  std::vector<ElementId> withinBrush(const View& view, QPointF position) const;
  void hoverBrush(View& view, QPointF position);
  void prepare(std::optional<ElementId> element);
  void outline(View& view, QPointF position);
  void setRingHovered(View* view);
  void followCursor(View& view, QPointF position, bool turns);
  void change(const View& view, bool turns);
  void turn(const View& view, QPointF position);
  std::optional<double> angleAt(const View& view, QPointF position) const;

  Document& document_;
  GrabBrush& brush_;
  RotationRing& ring_;
  Grip grip_ = Grip::nothing;
  Point start_ = Point::Zero();   // position of what is under the cursor when it was grabbed (mesh units)
  Point gripAt_ = Point::Zero();  // position of the cursor at that moment, in the same plane (mesh units)
  Motion motion_;
  QPointer<View> ringHovered_;     // the view whose ring is under the cursor
  const View* brushAt_ = nullptr;  // the view of the brush's outline
  std::vector<QPointF> outline_;
};

}  // namespace chainmail
