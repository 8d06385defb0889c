#include "docks/propagation_column.h"

#include <QEvent>
#include <QFont>
#include <QGuiApplication>
#include <QHeaderView>
#include <QLocale>
#include <QPalette>
#include <QStyle>
#include <QVBoxLayout>
#include <algorithm>
#include <numeric>

#include "common/colours.h"
#include "common/text.h"
#include "common/theme.h"
#include "document/panel_colour.h"
#include "drawing/colour_map.h"

namespace chainmail {
namespace {

constexpr int smallestWidth = 198;  // pixels, for three columns
constexpr int smallestList = 84;    // pixels, about four rows
constexpr int swatchSize = 10;
constexpr int cellMargin = 4;

}  // namespace

void WaitingListModel::show(const PassPlayer* player, std::size_t highest) {
  beginResetModel();
  player_ = player;
  highest_ = highest;
  waiting_.clear();
  next_ = 0;
  if (player != nullptr && player->history().known()) {
    waiting_ = player->history().at(player->step());
    while (next_ < waiting_.size() && waitingRow(next_).kind == Kind::drops) {
      ++next_;
    }
  } else if (player != nullptr) {
    waiting_.resize(player->stepCount() - player->step());
    std::iota(waiting_.begin(), waiting_.end(), std::uint32_t(player->step()));
  }
  endResetModel();
}

int WaitingListModel::rowCount(const QModelIndex& parent) const {
  return player_ == nullptr || parent.isValid() ? 0 : int(taken() + waiting_.size());
}

/// Returns the content of a row. The elements of the handle and each step of the trace count as taken, the last one
/// first. It is above the waiting ones, the others are below them.
WaitingListModel::Row WaitingListModel::row(int row) const {
  const auto i = std::size_t(row);
  if (i >= 1 && i <= waiting_.size()) {
    return waitingRow(i - 1);
  }
  const std::size_t back = i == 0 ? 0 : i - waiting_.size();
  if (back >= player_->step()) {
    return {player_->pass().handle[back - player_->step()], no_element, Kind::handle, true};
  }
  const TraceRow& taken = player_->pass().trace[player_->step() - 1 - back];
  return {taken.element, taken.sponsor, back == 0 ? Kind::current : Kind::done, taken.moved};
}

WaitingListModel::Row WaitingListModel::waitingRow(std::size_t i) const {
  if (!player_->history().known()) {
    const TraceRow& later = player_->pass().trace[waiting_[i]];
    return {later.element, later.sponsor, Kind::toCome, later.moved};
  }
  const WaitingCandidate& candidate = player_->history().candidates()[waiting_[i]];
  const bool drops = player_->updatedAt(candidate.element) <= player_->step();
  return {candidate.element, candidate.sponsor, drops ? Kind::drops : i == next_ ? Kind::next : Kind::waits, false};
}

std::optional<ElementId> WaitingListModel::elementAt(int row) const {
  return row >= 0 && row < rowCount() ? std::optional(this->row(row).element) : std::nullopt;
}

QString WaitingListModel::text(const Row& row, int column) const {
  if (column == element) {
    return QString::number(row.element);
  }
  if (column == sponsor) {
    return row.sponsor == no_element ? QStringLiteral("–") : QString::number(row.sponsor);
  }
  switch (row.kind) {
    case Kind::handle:
      return QStringLiteral("handle");
    case Kind::current:
      return row.moved ? QStringLiteral("moved") : QStringLiteral("stayed");
    case Kind::next:
      return QStringLiteral("next");
    case Kind::waits:
      return QStringLiteral("waits");
    case Kind::drops:
      return QStringLiteral("dropped");
    case Kind::toCome:
      return QStringLiteral("to come");
    case Kind::done:
      break;
  }
  return row.moved ? QStringLiteral("moved") : QStringLiteral("stayed");
}

/// Returns the colour of the element in the view; invalid if it is not updated yet.
QColor WaitingListModel::colour(const Row& row) const {
  const std::uint32_t at = player_->updatedAt(row.element);
  if (at == 0 || at > player_->step()) {
    return {};
  }
  return colour_map::at(highest_ > 1 ? double(at - 1) / double(highest_ - 1) : 0);
}

QVariant WaitingListModel::data(const QModelIndex& index, int role) const {
  const Row row = this->row(index.row());
  const bool isOver = row.kind == Kind::done || row.kind == Kind::drops;
  switch (role) {
    case Qt::DisplayRole:
      return text(row, index.column());
    case Qt::DecorationRole:
      return index.column() == element && colour(row).isValid() ? QVariant(colour(row)) : QVariant();
    case Qt::ForegroundRole:
      return isOver ? QVariant(QGuiApplication::palette().brush(QPalette::PlaceholderText)) : QVariant();
    case Qt::FontRole: {
      QFont font;
      font.setBold(row.kind == Kind::current || row.kind == Kind::next);
      font.setStrikeOut(row.kind == Kind::drops && index.column() == element);
      return font;
    }
    case Qt::ToolTipRole:
      return row.kind == Kind::drops
                 ? QStringLiteral("Element %1 is already updated: this candidate will be dropped").arg(row.element)
                 : QStringLiteral("Click to highlight element %1 in the panels").arg(row.element);
    default:
      return {};
  }
}

QVariant WaitingListModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || role != Qt::DisplayRole) {
    return {};
  }
  return section == element   ? QStringLiteral("Element")
         : section == sponsor ? QStringLiteral("Sponsor")
                              : QStringLiteral("State");
}

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
