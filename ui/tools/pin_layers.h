#pragma once

#include <QMenu>
#include <QObject>
#include <array>
#include <optional>

#include "document/document.h"
#include "mesh/layers.h"

namespace chainmail {

/// Pins a whole layer of the object at its current positions: the layer at one side of the object, or the boundary.
class PinLayers : public QObject {
  Q_OBJECT

 public:
  PinLayers(Document& document, QWidget* parent);

  /// The menu of all layers. Each entry shows the number of elements that it pins.
  QMenu& menu() { return *menu_; }
  /// Returns the bottom side, or the left side if the scene has no y axis.
  const ObjectSide& foot() const;
  void pin(const ObjectSide& side);
  void pinBoundary();

 private:
  struct Choice {
    const ObjectSide* side;  // null for the boundary
    QString name;            // for example 'bottom layer'
    QAction* action;
  };

  void add(const ObjectSide* side);
  std::vector<ElementId> elements(const ObjectSide* side) const;
  void pin(const std::vector<ElementId>& elements);
  void adapt();
  void count();
  void show(const Choice& choice, std::optional<std::size_t> count) const;

  Document& document_;
  QMenu* menu_;
  std::vector<Choice> choices_;
};

}  // namespace chainmail
