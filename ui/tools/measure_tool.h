#pragma once

#include "document/document.h"
#include "panels/overlay.h"
#include "panels/tool.h"

namespace chainmail {

/// The distance between two elements in every panel. It follows the elements when they move.
class Measurement : public QObject, public Overlay {
  Q_OBJECT

 public:
  explicit Measurement(const Document& document);

  const std::optional<ElementId>& from() const { return from_; }
  const std::optional<ElementId>& to() const { return to_; }
  /// True if both ends are chosen. Until then, to() is the element under the cursor.
  bool complete() const { return complete_; }
  void begin(ElementId from);
  void lead(std::optional<ElementId> to);
  void end(ElementId to);
  void clear();

  /// The distance in a panel (mesh units).
  struct Figures {
    Point apart;  // vector from the first element to the second
    double now, rest;
  };
  /// Requires that from() and to() have values.
  Figures figures(int panel) const;
  /// Returns the figures of all panels in one line; empty if nothing is measured.
  QString sentence() const;
  void draw(const Canvas&) override {}
  std::vector<Annotation> annotations(const View& view) const override;

 signals:
  void changed();

 private:
  void set(std::optional<ElementId> from, std::optional<ElementId> to, bool complete);

  const Document& document_;
  std::optional<ElementId> from_, to_;
  bool complete_ = false;
};

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
