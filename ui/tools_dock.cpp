#include "tools_dock.h"

#include <QActionGroup>
#include <QHBoxLayout>
#include <QToolButton>

namespace chainmail {

ToolsDock::ToolsDock(const QActionGroup& tools) : QDockWidget(QStringLiteral("Tools")) {
  setObjectName(QStringLiteral("toolsDock"));
  auto* content = new QWidget;
  auto* row = new QHBoxLayout(content);
  for (QAction* action : tools.actions()) {
    auto* button = new QToolButton;
    button->setDefaultAction(action);
    button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    button->setMinimumHeight(30);
    row->addWidget(button);
  }
  // Two buttons need no more height, however tall the column of docks is.
  content->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
  content->setFixedHeight(row->sizeHint().height());
  setWidget(content);
}

}  // namespace chainmail
