#pragma once

#include <QDockWidget>

class QAction;
class QStackedWidget;

namespace chainmail {

class Actions;
class CutTool;
class Document;
class SelectTool;

/// The tools of the left mouse button, and the options of the current tool.
class ToolsDock : public QDockWidget {
  Q_OBJECT

 public:
  ToolsDock(const Document& document, CutTool& cut, SelectTool& select, Actions& actions);

 private:
  QWidget* makeSelectOptions(SelectTool& select);
  static void addActions(Actions& actions, const Document& document, CutTool& cut);
  static QWidget* makeCutOptions(const Actions& actions);
  void showFor(QAction& tool, QWidget* options);

  QStackedWidget* options_;
  QWidget* without_;  // the page of a tool without options
};

}  // namespace chainmail
