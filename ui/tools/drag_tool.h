#pragma once

#include <QVector3D>
#include <optional>

#include "document/document.h"
#include "panels/tool.h"
#include "tools/control_points.h"

namespace chainmail {

/// Grabs the element under the cursor and moves it in all panels, in the plane through the element that is parallel to
/// the view. Near a control point of free-form deformation, grabs and moves that point instead.
class DragTool : public Tool {
 public:
  DragTool(Document& document, ControlPoints& controlPoints) : document_(document), controlPoints_(controlPoints) {}

  QString name() const override { return QStringLiteral("Drag"); }
  QString hint() const override;
  QCursor cursor() const override { return Qt::ArrowCursor; }

  void hover(View& view, QPointF position) override;
  void press(View& view, QPointF position, Qt::KeyboardModifiers modifiers) override;
  void move(View& view, QPointF position) override;
  void release(View& view, QPointF position) override;
  void leave(View& view) override;
  bool busy() const override { return grabbed_ || point_; }
  void cancel() override;
  std::span<const QPointF> stroke(const View&) const override { return {}; }

 private:
  bool pressOnPoint(View& view, QPointF position);

  Document& document_;
  ControlPoints& controlPoints_;
  std::optional<ElementId> grabbed_;
  std::optional<ControlPoints::PointId> point_;
  Point start_ = Point::Zero();  // position of the element or control point when it was grabbed (mesh units)
  QVector3D grip_;               // position of the cursor at that moment, in the same plane (mesh units)
};

}  // namespace chainmail
