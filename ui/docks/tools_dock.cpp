#include "docks/tools_dock.h"

#include <QActionGroup>
#include <QButtonGroup>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QSettings>
#include <QSpinBox>
#include <QStackedWidget>
#include <QToolButton>
#include <QVBoxLayout>

#include "common/actions.h"
#include "common/dock_scroll.h"
#include "common/icons.h"
#include "document/document.h"
#include "tools/cut_tool.h"
#include "tools/select_tool.h"

namespace chainmail {
namespace {

constexpr int toolHeight = 32, toolIcon = 20;  // pixels

QString splitsKey() { return QStringLiteral("cut/splits"); }

QToolButton* wideButton() {
  auto* button = new QToolButton;
  button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  return button;
}

}  // namespace

ToolsDock::ToolsDock(const Document& document, CutTool& cut, SelectTool& select, Actions& actions)
    : options_(new QStackedWidget), without_(new QWidget) {
  auto* content = new QWidget;
  auto* column = new QVBoxLayout(content);
  auto* strip = new QHBoxLayout;
  strip->setSpacing(2);
  for (QAction* action : actions["tool" + cut.name()].actionGroup()->actions()) {
    auto* button = wideButton();
    button->setDefaultAction(action);
    button->setToolButtonStyle(Qt::ToolButtonIconOnly);
    button->setIconSize({toolIcon, toolIcon});
    button->setFixedHeight(toolHeight);
    strip->addWidget(button);
  }
  column->addLayout(strip);
  column->addWidget(options_);
  options_->addWidget(without_);
  // A tall column of docks gives its height to other docks.
  content->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
  setWidget(new DockScroll(content));
  addActions(actions, document, cut);
  showFor(actions["tool" + cut.name()], makeCutOptions(actions));
  showFor(actions["tool" + select.name()], makeSelectOptions(select));
}

/// Shows options while their tool is the current one. Their room is kept for them, so that nothing below it moves.
void ToolsDock::showFor(QAction& tool, QWidget* options) {
  options_->addWidget(options);
  const auto adapt = [this, options](bool on) {
    if (on || options_->currentWidget() == options) {
      options_->setCurrentWidget(on ? options : without_);
    }
  };
  connect(&tool, &QAction::toggled, this, adapt);
  adapt(tool.isChecked());
}

/// Adds the options of the Cut tool, of which splitting is remembered.
void ToolsDock::addActions(Actions& actions, const Document& document, CutTool& cut) {
  cut.setSplits(QSettings().value(splitsKey(), true).toBool());
  actions.add("Edit",
              {{"cutFrontOnly", "Cut the &front layer only|Front layer only", "", "Shift+K",
                "On: a stroke cuts only visible links. Off: a stroke cuts through the whole object",
                [&cut](bool on) { cut.setFrontOnly(on); }, IsOn([&cut] { return cut.frontOnly(); }), When([&document] {
                  return document.mesh()->space_dimension == 3
                             ? QString()
                             : "Not available in 2D: a stroke cuts all links that it crosses";
                })},
               {"cutSplits", "Divide cells and triangles when cutting|Divide cells and triangles", "", "",
                "On: a stroke divides the cells of a volume, or the triangles of a surface, except where only links "
                "are drawn. Off: it cuts the links that it crosses, and cells with a cut link disappear",
                [&cut](bool on) {
                  cut.setSplits(on);
                  QSettings().setValue(splitsKey(), on);
                },
                IsOn([&cut] { return cut.splits(); }), When([&document] {
                  return can_split(*document.mesh()) ? QString()
                                                     : "Not available: a stroke cuts the links of lattices of faces "
                                                       "and of objects without cells and faces";
                })}});
}

QWidget* ToolsDock::makeCutOptions(const Actions& actions) {
  auto* options = new QWidget;
  auto* rows = new QVBoxLayout(options);
  rows->setContentsMargins(0, 0, 0, 0);
  for (QAction* action : actions.all({"cutFrontOnly", "cutSplits"})) {
    auto* button = wideButton();
    button->setDefaultAction(action);
    button->setObjectName(action->objectName() + "Button");
    rows->addWidget(button);
  }
  return options;
}

/// Makes the choice of rectangle or brush, and the radius of the brush.
QWidget* ToolsDock::makeSelectOptions(SelectTool& select) {
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
      QStringLiteral("Selects the elements in a rectangle"));
  add(QStringLiteral("Brush"), SelectTool::Shape::brush, 1, QStringLiteral("Selects the elements under the brush"));
  radius->setObjectName(QStringLiteral("brushRadius"));
  radius->setRange(SelectTool::smallestRadius, SelectTool::largestRadius);
  radius->setValue(select.radius());
  radius->setToolTip(QStringLiteral("Radius of the brush in pixels"));
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
