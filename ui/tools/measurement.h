#pragma once

#include "document/document.h"
#include "panels/overlay.h"

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

}  // namespace chainmail
