#pragma once

#include <QMenu>
#include <QObject>
#include <array>
#include <optional>

#include "document/document.h"
#include "mesh/layers.h"

namespace chainmail {

/// Pins a whole layer of the object where it stands: one at each side that the scene carries, or the boundary.
class PinLayers : public QObject {
  Q_OBJECT

 public:
  PinLayers(Document& document, QWidget* parent);

  /// The choices, with how many elements each pins; for menus of the window.
  QMenu& menu() { return *menu_; }
  /// The layer that an object stands on: the bottom, or where there is none the left.
  const ObjectSide& foot() const;
  void pin(const ObjectSide& side);
  void pinBoundary();

 private:
  struct Choice {
    const ObjectSide* side;  // none: the boundary
    QString name;            // 'bottom layer'
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
