#pragma once

#include <QMenu>
#include <QObject>
#include <QPointF>
#include <optional>
#include <vector>

#include "document/document.h"

namespace chainmail {

class View;

/// Returns the elements that are connected with this one by links that are not cut, with itself; ascending.
std::vector<ElementId> partWith(const Mesh& mesh, const Cuts& cuts, ElementId element);

/// The menu of an element in a view. A click with the right button opens it, while a drag with that button turns the
/// object; the Menu key opens it for the highlighted element.
class ElementMenu : public QObject {
  Q_OBJECT

 public:
  ElementMenu(Document& document, QWidget* window);

  /// Opens the menu for clicks in this view, too.
  void follow(View& view);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  QAction* add(const char* name, const QString& text, void (ElementMenu::*act)());
  bool isClick(QEvent& event);
  std::optional<ElementId> highlighted() const;
  void open(View& view, ElementId element, QPoint at);
  void close();
  void pin();
  void selectPart();
  void centre();
  void copyId();

  Document& document_;
  QMenu menu_;
  QAction* title_;
  QAction* pin_;
  View* view_ = nullptr;  // that opened the menu; null: what was shown is gone, and the actions do nothing
  ElementId element_ = 0;
  std::optional<QPointF> pressed_;  // by the right button alone, and not moved away since
};

}  // namespace chainmail
