#pragma once

#include <QDockWidget>
#include <QMenu>
#include <QTableWidget>

#include "docks/element_move.h"

namespace chainmail {

/// One element, picked by its id: where it stands, what holds it, and exact work on it without the mouse. It is the
/// selection, where that is a single element.
class ElementDock : public QDockWidget {
  Q_OBJECT

 public:
  explicit ElementDock(Document& document);

  /// The action that shows it, and gives its first field the keyboard.
  void fill(QMenu& menu);

 private:
  void arrange();
  QTableWidget* table(const char* name, const QString& accessible, const QStringList& columns);
  void listen();
  void adaptToMesh();
  void followSelection();
  void pick();
  void showElement();
  void showPlaces();
  void showNeighbours();
  void showNeighbour(int row, EntryId entry);
  void adaptButtons();
  /// The link of the row chosen in the table of neighbours.
  std::optional<LinkId> chosenLink() const;

  Document& document_;
  std::optional<ElementId> element_;
  QSpinBox* id_;
  QLabel* state_;
  QTableWidget* places_;
  QTableWidget* neighbours_;
  QPushButton* pin_;
  QPushButton* cut_;
  ElementMove* move_;
  QTimer refresh_;  // figures change at a rate that can be read, and only while they are seen
};

}  // namespace chainmail
