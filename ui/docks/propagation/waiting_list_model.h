#pragma once

#include <QAbstractTableModel>

#include "document/propagation.h"

namespace chainmail {

/// A pass at one step as a list: the candidate taken last on top, below it those that wait, the next one first, then
/// those that were taken before, the latest first. Where no waiting list is known, the steps to come stand in its
/// place.
class WaitingListModel : public QAbstractTableModel {
  Q_OBJECT

 public:
  enum Column { element, sponsor, what, columns };

  /// `highest` of the colours' scale, as in the views.
  void show(const PassPlayer* player, std::size_t highest);
  /// The element of a row.
  std::optional<ElementId> elementAt(int row) const;
  /// How many wait.
  std::size_t waitingCount() const { return waiting_.size(); }

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& /*parent*/ = {}) const override { return columns; }
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
  enum class Kind { hand, current, next, waits, drops, toCome, done };
  struct Row {
    ElementId element = 0, sponsor = no_element;
    Kind kind = Kind::hand;
    bool moved = true;
  };

  Row row(int row) const;
  Row waitingRow(std::size_t i) const;
  QString text(const Row& row, int column) const;
  QColor colour(const Row& row) const;

  const PassPlayer* player_ = nullptr;
  std::vector<std::uint32_t> waiting_;  // candidates, or rows of the trace where no list is known
  std::size_t next_ = 0;                // the first of them that will not be dropped
  std::size_t highest_ = 1;
};

}  // namespace chainmail
