#pragma once

#include <QObject>
#include <map>

#include "common/ask_bar.h"
#include "document/document.h"
#include "mesh/layers.h"
#include "panels/tool.h"

namespace chainmail {

class Actions;
struct ActionRow;

/// Pins a whole layer of the object at its current positions: the layer at one side of the object, or the boundary.
class PinLayers : public QObject {
  Q_OBJECT

 public:
  PinLayers(Document& document, QObject* parent);

  /// Adds the menu of all layers. When it opens, each entry shows the number of elements that it pins.
  void fill(Actions& actions);
  /// Returns the bottom side, or the left side if the scene has no y axis.
  const ObjectSide& foot() const;
  /// Pins a side, or the boundary if `side` is null.
  void pin(const ObjectSide* side);

 private:
  ActionRow rowOf(const ObjectSide* side);
  bool exists(const ObjectSide* side) const;
  std::vector<ElementId> elements(const ObjectSide* side) const;
  void count();

  Document& document_;
  std::map<const ObjectSide*, std::size_t> counts_;  // of elements to pin; null is the boundary; empty: not counted
};

/// Offers to pin the object if a panel has no solution because no element is pinned. It asks when the drag has ended.
/// It asks again only after a change of an algorithm, the object or the pins.
class PinBar : public AskBar {
  Q_OBJECT

 public:
  PinBar(Document& document, PinLayers& layers);

 signals:
  /// The user wants to pin with the pin tool.
  void byHandChosen();

 private:
  void addChoices();
  void await(int panel);
  void offer();
  void follow();

  Document& document_;
  PinLayers& layers_;
  int panel_ = 0;        // the panel without a solution
  bool awaits_ = false;  // waits for the end of the drag
  bool asked_ = false;
  QWidget* byHand_ = nullptr;
};

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
