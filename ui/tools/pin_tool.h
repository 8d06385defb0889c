#pragma once

#include "document/document.h"
#include "panels/tool.h"

namespace chainmail {

/// Pins the element under the cursor at its current position, or unpins it.
class PinTool : public Tool {
 public:
  explicit PinTool(Document& document) : document_(document) {}

  QString name() const override { return QStringLiteral("Pin"); }
  QString hint() const override;
  QCursor cursor() const override { return Qt::PointingHandCursor; }

  void hover(View& view, QPointF position) override;
  void press(View& view, QPointF position, Qt::KeyboardModifiers modifiers) override;
  void move(View&, QPointF, Qt::KeyboardModifiers) override {}
  void release(View& view, QPointF position) override { hover(view, position); }
  bool clicks() const override { return true; }
  bool busy() const override { return false; }
  void cancel() override { document_.highlight().set({}); }
  std::span<const QPointF> stroke(const View&) const override { return {}; }

 private:
  Document& document_;
};

}  // namespace chainmail
