#pragma once

#include "panels/tool.h"
#include "tools/measurement.h"

namespace chainmail {

/// Measures the distance between two elements, with a click on each.
class MeasureTool : public Tool {
 public:
  MeasureTool(Document& document, Measurement& measurement) : document_(document), measurement_(measurement) {}

  QString name() const override { return QStringLiteral("Measure"); }
  QString hint() const override;
  QCursor cursor() const override { return Qt::CrossCursor; }

  void hover(View& view, QPointF position) override;
  void press(View& view, QPointF position, Qt::KeyboardModifiers modifiers) override;
  void move(View&, QPointF, Qt::KeyboardModifiers) override {}
  void release(View& view, QPointF position) override { hover(view, position); }
  bool clicks() const override { return true; }
  bool busy() const override { return measurement_.from() && !measurement_.complete(); }
  void cancel() override;
  void escape() override;
  std::span<const QPointF> stroke(const View&) const override { return {}; }

 private:
  Document& document_;
  Measurement& measurement_;
};

}  // namespace chainmail
