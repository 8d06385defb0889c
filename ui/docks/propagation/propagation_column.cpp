#include "docks/propagation/propagation_column.h"

#include <QEvent>
#include <QHeaderView>
#include <QLocale>
#include <QStyle>
#include <QVBoxLayout>
#include <algorithm>

#include "common/colours.h"
#include "common/text.h"
#include "common/theme.h"
#include "document/panel_colour.h"

namespace chainmail {
namespace {

constexpr int smallestWidth = 198;  // pixels, for three columns
constexpr int smallestList = 84;    // pixels, about four rows
constexpr int swatchSize = 10;
constexpr int cellMargin = 4;

}  // namespace

PropagationColumn::PropagationColumn(Document& document, Propagation& propagation, int panel)
    : document_(document),
      propagation_(propagation),
      panel_(panel),
      title_(new QLabel),
      choice_(new QRadioButton(QStringLiteral("Step this panel"))),
      slider_(new QSlider(Qt::Horizontal)),
      state_(new QLabel),
      list_(new QTreeView) {
  title_->setTextFormat(Qt::RichText);
  title_->setObjectName(QStringLiteral("propagationPanel%1").arg(panel));
  choice_->setObjectName(QStringLiteral("propagationChoice%1").arg(panel));
  choice_->setAccessibleName(QStringLiteral("Step panel %1").arg(panelName(panel)));
  choice_->setToolTip(QStringLiteral("Buttons and keys step this panel. Its slider always does"));
  choice_->setAutoExclusive(false);
  slider_->setObjectName(QStringLiteral("propagationStep%1").arg(panel));
  slider_->setAccessibleName(QStringLiteral("Candidate of the pass in panel %1").arg(panelName(panel)));
  slider_->setToolTip(QStringLiteral("Number of candidates processed so far in this pass"));
  state_->setTextFormat(Qt::RichText);
  state_->setObjectName(QStringLiteral("propagationState%1").arg(panel));
  state_->setWordWrap(true);
  title_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);  // must not widen the dock
  makeList();
  arrange();
  connect(choice_, &QRadioButton::clicked, this, [this] {
    propagation_.choose(panel_);
    refresh();  // keeps the button checked
  });
  connect(slider_, &QSlider::valueChanged, this, [this](int step) { propagation_.setStep(panel_, std::size_t(step)); });
  followTheme(*title_, [this] { showTitle(); });
}

/// Shows the panel in its colour, which depends on the theme.
void PropagationColumn::showTitle() {
  title_->setText(QStringLiteral("<span style='color:%1'>●</span> <b>%2</b> %3")
                      .arg(QColor(panelColour(document_, panel_)).name(), panelName(panel_),
                           text(info(document_.algorithm(panel_)).label)));
}

void PropagationColumn::makeList() {
  list_->setObjectName(QStringLiteral("waitingList%1").arg(panel_));
  list_->setAccessibleName(QStringLiteral("Waiting list of panel %1").arg(panelName(panel_)));
  list_->setModel(&model_);
  list_->setRootIsDecorated(false);
  list_->setUniformRowHeights(true);
  list_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Ignored);  // the lists share the room that there is
  list_->setMinimumHeight(smallestList);
  list_->setAllColumnsShowFocus(true);
  list_->setTextElideMode(Qt::ElideNone);  // a number with missing digits would be another number
  list_->header()->setSectionResizeMode(QHeaderView::Fixed);
  list_->header()->setStretchLastSection(false);
  list_->viewport()->installEventFilter(this);
  list_->header()->setSectionsMovable(false);
  list_->header()->setMinimumSectionSize(30);
  connect(list_->selectionModel(), &QItemSelectionModel::currentChanged, this, [this](const QModelIndex& current) {
    if (const auto element = model_.elementAt(current.row())) {
      document_.highlight().set({*element, false, {}});
    }
  });
}

/// Makes each section as wide as its longest text. Where there is no room for all, the list scrolls.
void PropagationColumn::fitSections() {
  const int swatch = scaled(swatchSize, *this);
  list_->setIconSize({swatch, swatch});
  QFont bold = font();
  bold.setBold(true);
  const QFontMetrics metrics(bold);
  const int margins = 2 * (style()->pixelMetric(QStyle::PM_FocusFrameHMargin, nullptr, list_) + 1) + 2 * cellMargin;
  const int number = metrics.horizontalAdvance(QString::number(document_.mesh()->element_count()));
  const auto fitted = [&](int column, int content) {
    return std::max(list_->header()->sectionSizeHint(column) + cellMargin, content + margins);
  };
  const int ofElement = fitted(WaitingListModel::element, swatch + cellMargin + number);
  const int ofSponsor = fitted(WaitingListModel::sponsor, number);
  const int ofState = fitted(WaitingListModel::what, metrics.horizontalAdvance(WaitingListModel::longestState()));
  list_->header()->resizeSection(WaitingListModel::element, ofElement);
  list_->header()->resizeSection(WaitingListModel::sponsor, ofSponsor);
  list_->header()->resizeSection(WaitingListModel::what,
                                 std::max(ofState, list_->viewport()->width() - ofElement - ofSponsor));
}

void PropagationColumn::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::FontChange) {
    fitSections();
  }
}

/// The list has another width after a resize, and when its scroll bar appears.
bool PropagationColumn::eventFilter(QObject* watched, QEvent* event) {
  if (watched == list_->viewport() && event->type() == QEvent::Resize) {
    fitSections();
  }
  return QWidget::eventFilter(watched, event);
}

void PropagationColumn::arrange() {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  column->addWidget(title_);
  column->addWidget(choice_);
  column->addWidget(slider_);
  column->addWidget(state_);
  column->addWidget(list_, 1);
  setMinimumWidth(smallestWidth);
}

QString PropagationColumn::describe(const PassPlayer& player) const {
  const QLocale locale;
  QString text = QStringLiteral("Candidate <b>%1</b> of %2 · ")
                     .arg(locale.toString(qulonglong(player.step())), locale.toString(qulonglong(player.stepCount())));
  if (player.history().known()) {
    return text + QStringLiteral("<b>%1</b> waiting").arg(locale.toString(qulonglong(model_.waitingCount())));
  }
  if (player.pass().algorithm == Algorithm::exact) {
    return text + QStringLiteral("no waiting list: the table lists the next candidates, longest move first");
  }
  return text + (player.stepCount() > PassPlayer::listedSteps
                     ? QStringLiteral("the pass is too long for a waiting list: the table lists the next candidates")
                     : QStringLiteral("the waiting list is not known: the table lists the next candidates"));
}

void PropagationColumn::refresh() {
  const PassPlayer* player = propagation_.player(panel_);
  showTitle();
  choice_->setVisible(!propagation_.together());
  choice_->setChecked(propagation_.chosen() == panel_);
  model_.show(player, propagation_.stepCount());
  fitSections();
  const QSignalBlocker block(slider_);
  slider_->setEnabled(player != nullptr && player->stepCount() > 0);
  slider_->setRange(0, player != nullptr ? int(player->stepCount()) : 0);
  slider_->setPageStep(std::max(1, slider_->maximum() / 10));
  slider_->setValue(player != nullptr ? int(player->step()) : 0);
  state_->setText(!info(document_.algorithm(panel_)).has_steps()
                      ? QStringLiteral("No candidates: this method solves for all elements at once")
                  : player != nullptr ? describe(*player)
                                      : QStringLiteral("No pass yet: drag an element"));
}

}  // namespace chainmail
