#include "tools_dock.h"

#include <QActionGroup>
#include <QButtonGroup>
#include <QGridLayout>
#include <QLabel>
#include <QSpinBox>
#include <QToolButton>

#include "icons.h"
#include "select_tool.h"

namespace chainmail {
namespace {

constexpr int columns = 2;
constexpr int toolHeight = 30;

QToolButton* wideButton() {
  auto* button = new QToolButton;
  button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  return button;
}

}  // namespace

ToolsDock::ToolsDock(const QActionGroup& tools, SelectTool& select, const QAction& selectAction)
    : QDockWidget(QStringLiteral("Tools")) {
  setObjectName(QStringLiteral("toolsDock"));
  auto* content = new QWidget;
  auto* column = new QVBoxLayout(content);
  auto* grid = new QGridLayout;
  for (QAction* action : tools.actions()) {
    auto* button = wideButton();
    button->setDefaultAction(action);
    button->setMinimumHeight(toolHeight);
    const int i = int(tools.actions().indexOf(action));
    grid->addWidget(button, i / columns, i % columns);
  }
  column->addLayout(grid);
  QWidget* options = makeOptions(select);
  column->addWidget(options);
  setWidget(content);
  // The buttons need no more height, however tall the column of docks is.
  content->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
  const auto adapt = [content, column, options, &selectAction] {
    options->setVisible(selectAction.isChecked());
    content->setFixedHeight(column->sizeHint().height());
  };
  connect(&selectAction, &QAction::toggled, this, adapt);
  adapt();
}

/// Rectangle or brush, and the brush's radius.
QWidget* ToolsDock::makeOptions(SelectTool& select) {
  auto* options = new QWidget;
  auto* grid = new QGridLayout(options);
  grid->setContentsMargins(0, 0, 0, 0);
  auto* shapes = new QButtonGroup(options);
  auto* radius = new QSpinBox;
  const auto add = [&](const QString& name, SelectTool::Shape shape, int column, const QString& help) {
    auto* button = wideButton();
    button->setText(name);
    button->setToolTip(help);
    button->setIcon(icon(qPrintable(QStringLiteral("select") + name)));
    button->setObjectName(QStringLiteral("select") + name);
    button->setCheckable(true);
    button->setChecked(select.shape() == shape);
    shapes->addButton(button);
    grid->addWidget(button, 0, column);
    connect(button, &QToolButton::toggled, this, [&select, shape, radius](bool on) {
      if (on) {
        select.setShape(shape);
        radius->setEnabled(shape == SelectTool::Shape::brush);
      }
    });
  };
  add(QStringLiteral("Rectangle"), SelectTool::Shape::rectangle, 0,
      QStringLiteral("Selects the elements in a rectangle that is drawn"));
  add(QStringLiteral("Brush"), SelectTool::Shape::brush, 1,
      QStringLiteral("Selects the elements that the brush goes over"));
  radius->setObjectName(QStringLiteral("brushRadius"));
  radius->setRange(SelectTool::smallestRadius, SelectTool::largestRadius);
  radius->setValue(select.radius());
  radius->setToolTip(QStringLiteral("How far from the cursor the brush reaches, in pixels"));
  radius->setSuffix(QStringLiteral(" px"));
  radius->setKeyboardTracking(false);
  radius->setEnabled(select.shape() == SelectTool::Shape::brush);
  connect(radius, &QSpinBox::valueChanged, this, [&select](int value) { select.setRadius(value); });
  connect(radius, &QSpinBox::editingFinished, radius, &QWidget::clearFocus);  // shortcuts work again
  auto* label = new QLabel(QStringLiteral("Brush radius"));
  label->setBuddy(radius);
  grid->addWidget(label, 1, 0);
  grid->addWidget(radius, 1, 1);
  return options;
}

}  // namespace chainmail
