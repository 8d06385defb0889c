#include "docks/propagation/waiting_list_model.h"

#include <QFont>
#include <QGuiApplication>
#include <QPalette>
#include <numeric>

#include "drawing/colour_map.h"

namespace chainmail {

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

}  // namespace chainmail
