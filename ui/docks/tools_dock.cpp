#include "docks/tools_dock.h"

#include <QActionGroup>
#include <QButtonGroup>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QSettings>
#include <QSpinBox>
#include <QStackedWidget>
#include <QToolButton>
#include <QVBoxLayout>

#include "common/dock_scroll.h"
#include "common/icons.h"
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

ToolsDock::ToolsDock(const QActionGroup& tools, Document& document, CutTool& cut, SelectTool& select)
    : options_(new QStackedWidget), without_(new QWidget) {
  auto* content = new QWidget;
  auto* column = new QVBoxLayout(content);
  auto* strip = new QHBoxLayout;
  strip->setSpacing(2);
  for (QAction* action : tools.actions()) {
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
  for (QAction* action : tools.actions()) {
    if (action->text() == cut.name()) {
      showFor(*action, makeCutOptions(document, cut));
    } else if (action->text() == select.name()) {
      showFor(*action, makeSelectOptions(select));
    }
  }
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

/// Inserts the action between the tools and Cancel.
void ToolsDock::fill(QMenu& menu) { menu.insertActions(menu.actions().constLast(), {frontOnly_, splits_}); }

QWidget* ToolsDock::makeCutOptions(Document& document, CutTool& cut) {
  auto* options = new QWidget;
  auto* rows = new QVBoxLayout(options);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->addWidget(makeFrontOnly(document, cut));
  rows->addWidget(makeSplits(document, cut));
  return options;
}

/// Makes the switch between splitting faces and cutting links, which is remembered.
QWidget* ToolsDock::makeSplits(Document& document, CutTool& cut) {
  splits_ = new QAction(QStringLiteral("Split triangles when cutting"), this);
  splits_->setObjectName(QStringLiteral("cutSplits"));
  splits_->setIconText(QStringLiteral("Split triangles"));
  splits_->setCheckable(true);
  splits_->setChecked(QSettings().value(splitsKey(), true).toBool());
  cut.setSplits(splits_->isChecked());
  connect(splits_, &QAction::toggled, this, [&cut](bool on) {
    cut.setSplits(on);
    QSettings().setValue(splitsKey(), on);
  });
  const auto adapt = [this, &document] {
    const Mesh& mesh = *document.mesh();
    splits_->setEnabled(can_split(mesh));
    splits_->setStatusTip(
        can_split(mesh) ? QStringLiteral("On: a stroke splits the triangles that it crosses, except where only links "
                                         "are drawn. Off: it cuts the links that it crosses")
                        : QStringLiteral("Not available: a stroke cuts the links of volumes, of generated lattices and "
                                         "of objects without faces"));
    splits_->setToolTip(splits_->statusTip());
  };
  connect(&document, &Document::meshChanged, this, adapt);
  adapt();
  auto* button = wideButton();
  button->setDefaultAction(splits_);
  button->setObjectName(QStringLiteral("cutSplitsButton"));
  return button;
}

/// Makes the switch between cutting the front layer and the whole object; disabled in 2D.
QWidget* ToolsDock::makeFrontOnly(Document& document, CutTool& cut) {
  frontOnly_ = new QAction(QStringLiteral("Cut the &front layer only"), this);
  frontOnly_->setObjectName(QStringLiteral("cutFrontOnly"));
  frontOnly_->setIconText(QStringLiteral("Front layer only"));
  frontOnly_->setCheckable(true);
  frontOnly_->setShortcut(Qt::SHIFT | Qt::Key_K);
  connect(frontOnly_, &QAction::toggled, this, [&cut](bool on) { cut.setFrontOnly(on); });
  const auto adapt = [this, &document] {
    const bool spatial = document.mesh()->space_dimension == 3;
    frontOnly_->setEnabled(spatial);
    frontOnly_->setStatusTip(
        spatial ? QStringLiteral("On: a stroke cuts only visible links. Off: a stroke cuts through the whole object")
                : QStringLiteral("Not available in 2D: a stroke cuts all links that it crosses"));
    frontOnly_->setToolTip(frontOnly_->statusTip() + QStringLiteral(" (Shift+K)"));
  };
  connect(&document, &Document::meshChanged, this, adapt);
  adapt();
  auto* button = wideButton();
  button->setDefaultAction(frontOnly_);
  button->setObjectName(QStringLiteral("cutFrontOnlyButton"));
  return button;
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
