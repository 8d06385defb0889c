#pragma once

#include <QVector3D>
#include <optional>

#include "document.h"
#include "tool.h"

namespace chainmail {

/// Takes hold of the element under the cursor and moves it in all panels, in the plane parallel to the
/// view through the element.
class DragTool : public Tool {
 public:
  explicit DragTool(Document& document) : document_(document) {}

  QString name() const override { return QStringLiteral("Drag"); }
  QString hint() const override;
  QCursor cursor() const override { return Qt::ArrowCursor; }

  void hover(View& view, QPointF place) override;
  void press(View& view, QPointF place, Qt::KeyboardModifiers modifiers) override;
  void move(View& view, QPointF place) override;
  void release(View& view, QPointF place) override;
  bool busy() const override { return grabbed_.has_value(); }
  void cancel() override;
  std::span<const QPointF> stroke(const View&) const override { return {}; }

 private:
  Document& document_;
  std::optional<ElementId> grabbed_;
  Point start_ = Point::Zero();  // where the element was taken (mesh units)
  QVector3D hand_;               // where the cursor was then, in the same plane
};

}  // namespace chainmail
