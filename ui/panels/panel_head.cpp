#include "panels/panel_head.h"

#include <QAbstractItemView>
#include <QApplication>
#include <QEvent>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QPainter>
#include <QSlider>
#include <QStandardItemModel>
#include <QStyledItemDelegate>
#include <QWidgetAction>
#include <cmath>

#include "common/icons.h"
#include "common/text.h"
#include "common/theme.h"
#include "document/edits.h"
#include "document/element_facts.h"
#include "document/panel_colour.h"
#include "mesh/error.h"
#include "panels/view.h"

namespace chainmail {
namespace {

constexpr int blendSteps = 100;
constexpr int sliderWidth = 180;

constexpr int margin = 8, padding = 4;  // pixels
constexpr double smaller = 0.88;        // size of the explanation, relative to the name

QFont smallFont(QFont font) {
  font.setPointSizeF(smaller * font.pointSizeF());
  return font;
}

/// Draws the entries of an algorithm list: the name, and a line below it that explains the algorithm or says why it is
/// not available.
class AlgorithmDelegate : public QStyledItemDelegate {
 public:
  /// The role of the line below the name.
  static constexpr int explanationRole = Qt::UserRole + 1;

  using QStyledItemDelegate::QStyledItemDelegate;

  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override;
  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override;
};

void AlgorithmDelegate::paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const {
  const QString explanation = index.data(explanationRole).toString();
  if (explanation.isEmpty()) {
    QStyledItemDelegate::paint(painter, option, index);  // a separator
    return;
  }
  QStyleOptionViewItem item = option;
  initStyleOption(&item, index);
  const QString name = item.text;
  item.text.clear();
  (item.widget != nullptr ? item.widget->style() : QApplication::style())
      ->drawControl(QStyle::CE_ItemViewItem, &item, painter, item.widget);
  const bool enabled = (item.state & QStyle::State_Enabled) != 0, selected = (item.state & QStyle::State_Selected) != 0;
  const auto group = enabled ? QPalette::Active : QPalette::Disabled;
  painter->save();
  painter->setPen(item.palette.color(group, selected ? QPalette::HighlightedText : QPalette::Text));
  const QRect inner = option.rect.adjusted(margin, padding, -margin, -padding);
  painter->setFont(item.font);
  painter->drawText(inner, Qt::AlignLeft | Qt::AlignTop, name);
  painter->setOpacity(enabled && !selected ? 0.75 : 1);
  painter->setFont(smallFont(item.font));
  painter->drawText(inner, Qt::AlignLeft | Qt::AlignBottom, explanation);
  painter->restore();
}

QSize AlgorithmDelegate::sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const {
  const QString explanation = index.data(explanationRole).toString();
  if (explanation.isEmpty()) {
    return QStyledItemDelegate::sizeHint(option, index);
  }
  const QFontMetrics large(option.font), small(smallFont(option.font));
  return {std::max(large.horizontalAdvance(index.data().toString()), small.horizontalAdvance(explanation)) + 2 * margin,
          large.height() + small.height() + 2 * padding};
}

constexpr int smallestSelector = 90;  // pixels; in a narrow panel, the name is shortened
constexpr int swatchSize = 10;        // pixels, at the usual size of texts
constexpr int leastHeight = 28;       // pixels
constexpr int listMargin = 30;        // pixels, for the scroll bar and the frame of the list

QString joined(const QStringList& states) { return states.join(QStringLiteral(" · ")); }

}  // namespace

GhostButton::GhostButton(Document& document, View& view, int panel)
    : document_(document), view_(view), panel_(panel), menu_(new QMenu(this)) {
  setObjectName(QStringLiteral("ghostButton%1").arg(panel));
  setAccessibleName(QStringLiteral("Ghost in panel %1").arg(panelName(panel)));
  setToolTip(QStringLiteral("Shows another panel's object over this one, see-through and in that panel's colour"));
  setIcon(chainmail::icon("overlay"));
  setAutoRaise(true);
  setCheckable(true);
  setPopupMode(InstantPopup);
  menu_->setObjectName(QStringLiteral("ghostMenu%1").arg(panel));
  menu_->setToolTipsVisible(true);
  setMenu(menu_);
  connect(menu_, &QMenu::aboutToShow, this, &GhostButton::fill);
  connect(&view, &View::ghostChanged, this, [this] { setChecked(view_.ghost().of.has_value()); });
}

/// Fills the menu each time it opens, because panels and their algorithms change.
void GhostButton::fill() {
  menu_->clear();
  addChoice(QStringLiteral("No ghost"), std::nullopt);
  for (int other = 0; other < document_.panels(); ++other) {
    if (other != panel_) {
      const QString algorithm = chainmail::text(info(document_.algorithm(other)).label);
      addChoice(QStringLiteral("Panel &%1: %2").arg(panelName(other), algorithm), other);
    }
  }
  menu_->addSeparator();
  addBlend();
}

void GhostButton::addChoice(const QString& choice, std::optional<int> of) {
  auto* action = menu_->addAction(choice, this, [this, of] { view_.setGhost({of, view_.ghost().blend}); });
  action->setCheckable(true);
  action->setChecked(view_.ghost().of == of);
}

void GhostButton::addBlend() {
  auto* content = new QWidget;
  auto* grid = new QGridLayout(content);
  grid->setContentsMargins(10, 4, 10, 6);
  auto* slider = new QSlider(Qt::Horizontal);
  slider->setObjectName(QStringLiteral("ghostBlend%1").arg(panel_));
  slider->setAccessibleName(QStringLiteral("Blend between this panel's object and the ghost"));
  slider->setRange(0, blendSteps);
  slider->setValue(int(std::lround(view_.ghost().blend * blendSteps)));
  slider->setMinimumWidth(sliderWidth);
  slider->setEnabled(view_.ghost().of.has_value());
  slider->setToolTip(slider->isEnabled() ? QStringLiteral("Left: only this panel's object. Right: only the ghost")
                                         : QStringLiteral("There is no ghost yet: choose a panel above"));
  connect(slider, &QSlider::valueChanged, this, [this](int value) {
    view_.setGhost({view_.ghost().of, double(value) / blendSteps});
  });
  grid->addWidget(new QLabel(QStringLiteral("This panel")), 0, 0, Qt::AlignLeft);
  grid->addWidget(new QLabel(QStringLiteral("Ghost")), 0, 1, Qt::AlignRight);
  grid->addWidget(slider, 1, 0, 1, 2);
  auto* action = new QWidgetAction(menu_);
  action->setDefaultWidget(content);
  menu_->addAction(action);
}

PanelHead::PanelHead(Document& document, View& view, int panel)
    : document_(document),
      panel_(panel),
      selector_(new QComboBox),
      swatch_(new QLabel),
      state_(new QLabel),
      alone_(makeAloneButton()),
      pin_(new QToolButton),
      row_(new QHBoxLayout(this)) {
  state_->setObjectName(QStringLiteral("state%1").arg(panel));
  state_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  // The text changes during a drag and must not resize the view.
  state_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  state_->installEventFilter(this);
  fillSelector();
  arrange(view);
  followPins();
}

/// Shows a button that pins the bottom while the algorithm needs pins and there are none.
void PanelHead::followPins() {
  pin_->setObjectName(QStringLiteral("pinBottom%1").arg(panel_));
  pin_->setText(QStringLiteral("Pin bottom"));
  pin_->setIcon(icon("pin"));
  pin_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  pin_->setToolTip(
      QStringLiteral("Without pins, this algorithm has no solution. Pins the bottom layer at its present "
                     "positions, as one undo step"));
  connect(pin_, &QToolButton::clicked, this, &PanelHead::pinWanted);
  const auto adapt = [this] { pin_->setVisible(panel_ < document_.panels() && lacksPins(document_, panel_)); };
  connect(&document_, &Document::pinsChanged, pin_, adapt);
  connect(&document_, &Document::meshChanged, pin_, adapt);
  connect(&document_, &Document::algorithmChanged, pin_, adapt);
  adapt();
}

void PanelHead::fillSelector() {
  selector_->setObjectName(QStringLiteral("algorithm%1").arg(panel_));
  selector_->setAccessibleName(QStringLiteral("Algorithm of panel %1").arg(panelName(panel_)));
  selector_->setToolTip(QStringLiteral("The algorithm that deforms this panel's object"));
  selector_->setMinimumWidth(smallestSelector);
  selector_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  for (const auto& info : every_algorithm()) {
    if (info.algorithm == elastic_algorithms().front().algorithm) {
      selector_->insertSeparator(selector_->count());
    }
    selector_->addItem(text(info.label), int(info.algorithm));
  }
  selector_->setMaxVisibleItems(selector_->count());
  selector_->setItemDelegate(new AlgorithmDelegate(selector_));
  connect(selector_, &QComboBox::activated, this,
          [this] { edits::setAlgorithm(document_, panel_, Algorithm(selector_->currentData().toInt())); });
  connect(&document_, &Document::algorithmChanged, this, [this](int panel) {
    if (panel == panel_) {
      showAlgorithm();
    }
  });
  connect(&document_, &Document::meshChanged, this, &PanelHead::showAlgorithm);
  showAlgorithm();
}

/// Selects the current algorithm. Disables algorithms that do not work on this mesh; a tooltip gives the reason.
void PanelHead::showAlgorithm() {
  const auto* items = qobject_cast<QStandardItemModel*>(selector_->model());
  for (int i = 0; i < selector_->count(); ++i) {
    if (!selector_->itemData(i).isValid()) {
      continue;  // a separator
    }
    const auto algorithm = Algorithm(selector_->itemData(i).toInt());
    QString help = text(info(algorithm).source), explanation = sentence(text(info(algorithm).summary));
    try {
      check(algorithm, *document_.mesh());
      items->item(i)->setEnabled(true);
    } catch (const Error& error) {
      items->item(i)->setEnabled(false);
      help = QString::fromStdString(error.what());
      explanation = QStringLiteral("Not available: %1").arg(text(error.problem()));
    }
    items->item(i)->setToolTip(help);
    items->item(i)->setData(explanation, AlgorithmDelegate::explanationRole);
  }
  selector_->setCurrentIndex(selector_->findData(int(document_.algorithm(panel_))));
  fitList();
}

void PanelHead::fitList() { selector_->view()->setMinimumWidth(selector_->view()->sizeHintForColumn(0) + listMargin); }

/// Shows the colour of the panel as a disc that grows with the texts.
void PanelHead::fitSwatch() {
  const int size = scaled(swatchSize, *this);
  swatch_->setFixedSize(size, size);
  swatch_->setStyleSheet(QStringLiteral("background:%1; border-radius:%2px")
                             .arg(QColor(panelColour(document_, panel_)).name())
                             .arg(size / 2));
}

void PanelHead::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::FontChange) {
    fitList();
    fitSwatch();
    fitStates();
  }
}

QToolButton* PanelHead::makeAloneButton() {
  auto* button = new QToolButton;
  button->setObjectName(QStringLiteral("aloneButton%1").arg(panel_));
  button->setAccessibleName(QStringLiteral("Show only panel %1").arg(panelName(panel_)));
  button->setToolTip(QStringLiteral("Shows only this panel, or all panels again (also: double-click here)"));
  button->setIcon(icon("alone"));
  button->setCheckable(true);
  button->setAutoRaise(true);
  connect(button, &QToolButton::clicked, this, &PanelHead::aloneToggled);
  return button;
}

void PanelHead::arrange(View& view) {
  auto* name = new QLabel(panelName(panel_));
  QFont bold = name->font();
  bold.setBold(true);
  name->setFont(bold);
  followTheme(*this, [this] { fitSwatch(); });  // its style sheet hides changes of the palette from the swatch
  connect(&document_, &Document::algorithmChanged, swatch_, [this] { fitSwatch(); });
  row_->setContentsMargins(8, 1, 4, 1);
  row_->setSpacing(8);
  setMinimumHeight(leastHeight);
  row_->addWidget(swatch_);
  row_->addWidget(name);
  row_->addWidget(selector_);
  row_->addWidget(pin_);
  row_->addWidget(state_, 1);
  row_->addWidget(new GhostButton(document_, view, panel_));
  row_->addWidget(alone_);
}

void PanelHead::showStates(const QStringList& states) {
  states_ = states;
  state_->setToolTip(joined(states));
  fitStates();
}

void PanelHead::fitStates() {
  qsizetype fitting = states_.size();
  while (fitting > 0 && state_->fontMetrics().horizontalAdvance(joined(states_.first(fitting))) > state_->width()) {
    --fitting;
  }
  state_->setText(joined(states_.first(fitting)));
  emit leftOver(states_.sliced(fitting));
}

bool PanelHead::eventFilter(QObject* watched, QEvent* event) {
  if (watched == state_ && event->type() == QEvent::Resize) {
    fitStates();
  }
  return QWidget::eventFilter(watched, event);
}

void PanelHead::showAlone(bool alone) { alone_->setChecked(alone); }

void PanelHead::setActions(const QList<QAction*>& actions) {
  for (QAction* action : actions) {
    auto* button = new QToolButton;
    button->setDefaultAction(action);
    button->setObjectName(action->objectName().chopped(5) + QStringLiteral("Button%1").arg(panel_));
    button->setAutoRaise(true);
    row_->addWidget(button);
    setTabOrder(buttons_.isEmpty() ? alone_ : buttons_.last(), button);
    buttons_ << button;
    connect(action, &QAction::changed, button, [this] { showActions(shownActions_); });
  }
}

void PanelHead::showActions(const QList<QAction*>& shown) {
  shownActions_ = shown;
  for (QToolButton* button : buttons_) {
    button->setVisible(shown.contains(button->defaultAction()) && button->defaultAction()->isEnabled());
  }
}

void PanelHead::mouseDoubleClickEvent(QMouseEvent* /*event*/) { emit aloneToggled(); }

}  // namespace chainmail
