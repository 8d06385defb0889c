#pragma once

#include <QDockWidget>

namespace chainmail {

class Document;

/// The undo list: the name of every step. A click on a step goes back to it.
class HistoryDock : public QDockWidget {
  Q_OBJECT

 public:
  explicit HistoryDock(Document& document);
};

}  // namespace chainmail
