#pragma once

#include <QDockWidget>
#include <QTableWidget>
#include <QTimer>

#include "docks/element_move.h"

namespace chainmail {

/// One element, selected by its id: its positions, links and pin, and exact edits without the mouse. Follows the
/// selection. If many elements are selected, it moves and rotates them by numbers.
class ElementDock : public QDockWidget {
  Q_OBJECT

 public:
  explicit ElementDock(Document& document);

 private:
  class IdBox;

  void arrange();
  QTableWidget* table(const char* name, const QString& accessible, const QStringList& columns);
  void listen();
  void adaptToMesh();
  void followSelection();
  void pick();
  void showElement();
  QString stateText() const;
  void showPositions();
  void showNeighbours();
  void showNeighbour(int row, EntryId entry);
  void adaptButtons();
  /// Returns the link of the selected row in the table of neighbours.
  std::optional<LinkId> chosenLink() const;

  Document& document_;
  std::optional<ElementId> element_;
  std::optional<int> missing_;  // the last typed id, if the mesh has no such element
  IdBox* id_;
  QLabel* state_;
  QTableWidget* positions_;
  QTableWidget* neighbours_;
  QPushButton* pin_;
  QPushButton* cut_;
  ElementMove* move_;
  QTimer refresh_;  // limits the rate of updates; stopped while the dock is hidden
};

}  // namespace chainmail
