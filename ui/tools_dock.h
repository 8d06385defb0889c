#pragma once

#include <QDockWidget>

class QAction;
class QActionGroup;

namespace chainmail {

class SelectTool;

/// The tools, one of which is what the left mouse button does, and below them the options of the one in use.
class ToolsDock : public QDockWidget {
  Q_OBJECT

 public:
  ToolsDock(const QActionGroup& tools, SelectTool& select, const QAction& selectAction);

 private:
  QWidget* makeOptions(SelectTool& select);
};

}  // namespace chainmail
