#include "panels/panel_head.h"

#include <QAbstractItemView>
#include <QEvent>
#include <QHBoxLayout>
#include <QStandardItemModel>
#include <QToolButton>

#include "common/icons.h"
#include "common/text.h"
#include "common/theme.h"
#include "document/edits.h"
#include "document/element_facts.h"
#include "document/panel_colour.h"
#include "mesh/error.h"
#include "panels/algorithm_delegate.h"
#include "panels/ghost_button.h"

namespace chainmail {
namespace {

constexpr int smallestSelector = 90;  // pixels; in a narrow panel, the name is shortened
constexpr int swatchSize = 10;        // pixels, at the usual size of texts
constexpr int leastHeight = 28;       // pixels
constexpr int listMargin = 30;        // pixels, for the scroll bar and the frame of the list

QString joined(const QStringList& states) { return states.join(QStringLiteral(" · ")); }

QString sentence(const QString& words) { return words.left(1).toUpper() + words.mid(1); }

}  // namespace

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
