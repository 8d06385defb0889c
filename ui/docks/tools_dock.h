#pragma once

#include <QDockWidget>

class QAction;
class QActionGroup;
class QMenu;
class QVBoxLayout;

namespace chainmail {

class CutTool;
class Document;
class SelectTool;

/// The tools, one of which is what the left mouse button does, and below them the options of the one in use.
class ToolsDock : public QDockWidget {
  Q_OBJECT

 public:
  ToolsDock(const QActionGroup& tools, Document& document, CutTool& cut, SelectTool& select);

  /// What of the tools' options is an action too.
  void fill(QMenu& menu);

 private:
  QWidget* makeSelectOptions(SelectTool& select);
  QWidget* makeCutOptions(Document& document, CutTool& cut);
  void showFor(QAction& tool, QWidget* options);

  QVBoxLayout* column_;
  QAction* frontOnly_ = nullptr;
};

}  // namespace chainmail
