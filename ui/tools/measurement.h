#pragma once

#include "document/document.h"
#include "panels/overlay.h"

namespace chainmail {

/// The distance between two elements, in every panel; it stays with the elements as they move.
class Measurement : public QObject, public Overlay {
  Q_OBJECT

 public:
  explicit Measurement(const Document& document);

  const std::optional<ElementId>& from() const { return from_; }
  const std::optional<ElementId>& to() const { return to_; }
  /// Whether both ends are chosen for good: before, `to` is what the cursor is at.
  bool complete() const { return complete_; }
  void begin(ElementId from);
  void lead(std::optional<ElementId> to);
  void end(ElementId to);
  void clear();

  /// In mesh units; both ends must be there.
  struct Figures {
    Point apart;  // from one to the other
    double now, rest;
  };
  Figures figures(int panel) const;
  /// All panels' figures in a line; empty where nothing is measured.
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
