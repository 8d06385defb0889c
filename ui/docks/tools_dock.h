#pragma once

#include <QDockWidget>

class QAction;
class QActionGroup;
class QMenu;
class QStackedWidget;

namespace chainmail {

class CutTool;
class Document;
class SelectTool;

/// The tools of the left mouse button, and the options of the current tool.
class ToolsDock : public QDockWidget {
  Q_OBJECT

 public:
  ToolsDock(const QActionGroup& tools, Document& document, CutTool& cut, SelectTool& select);

  /// Adds the options that are actions to the Edit menu.
  void fill(QMenu& menu);

 private:
  QWidget* makeSelectOptions(SelectTool& select);
  QWidget* makeCutOptions(Document& document, CutTool& cut);
  QWidget* makeFrontOnly(Document& document, CutTool& cut);
  QWidget* makeSplits(Document& document, CutTool& cut);
  void showFor(QAction& tool, QWidget* options);

  QStackedWidget* options_;
  QWidget* without_;  // the page of a tool without options
  QAction* frontOnly_ = nullptr;
  QAction* splits_ = nullptr;
};

}  // namespace chainmail
