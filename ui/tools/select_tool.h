#pragma once

#include <QLineF>
#include <vector>

#include "document/document.h"
#include "panels/tool.h"

namespace chainmail {

/// Selects all elements in a rectangle or under the strokes of a brush, including elements that others hide.
class SelectTool : public Tool {
 public:
  enum class Shape { rectangle, brush };
  static constexpr int smallestRadius = 4, standardRadius = 24, largestRadius = 200;  // pixels

  explicit SelectTool(Document& document) : document_(document) {}

  Shape shape() const { return shape_; }
  void setShape(Shape shape);
  int radius() const { return radius_; }
  void setRadius(int radius) { radius_ = radius; }

  QString name() const override { return QStringLiteral("Select"); }
  QString hint() const override;
  QCursor cursor() const override { return Qt::CrossCursor; }

  void hover(View& view, QPointF position) override;
  void press(View& view, QPointF position, Qt::KeyboardModifiers modifiers) override;
  void move(View& view, QPointF position, Qt::KeyboardModifiers modifiers) override;
  void release(View& view, QPointF position) override;
  bool busy() const override { return pressed_; }
  void cancel() override;
  void escape() override;
  void leave(View& view) override;
  std::span<const QPointF> stroke(const View& view) const override;

 private:
  void brush(View& view, QLineF along);
  void outline(QPointF position);

  Document& document_;
  Shape shape_ = Shape::rectangle;
  int radius_ = standardRadius;
  const View* at_ = nullptr;  // the view of the outline
  bool pressed_ = false;
  SelectionMode mode_ = SelectionMode::replace;
  QPointF start_, last_;
  MeshPointer mesh_;               // the mesh when the stroke started
  std::vector<ElementId> before_;  // the selection when the stroke started
  std::vector<ElementId> hit_;
  std::vector<QPointF> outline_;
};

}  // namespace chainmail
