#pragma once

#include <QAbstractTableModel>
#include <QLabel>
#include <QRadioButton>
#include <QSlider>
#include <QTreeView>
#include <QWidget>

#include "document/propagation.h"

namespace chainmail {

/// A table of a pass at one step. The first row is the candidate taken last. Then come the waiting candidates, in the
/// order in which they will be taken, then the candidates taken before, the latest first, and the handle. If the
/// waiting list is unknown, the remaining steps of the pass replace it.
class WaitingListModel : public QAbstractTableModel {
  Q_OBJECT

 public:
  enum Column { element, sponsor, what, columns };

  /// `highest` is the highest step of the colour scale, as in the views.
  void show(const PassPlayer* player, std::size_t highest);
  /// Returns the longest text of the column `what`.
  static QString longestState() { return QStringLiteral("dropped"); }
  /// Returns the element of a row.
  std::optional<ElementId> elementAt(int row) const;
  /// Number of waiting candidates.
  std::size_t waitingCount() const { return waiting_.size(); }

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& /*parent*/ = {}) const override { return columns; }
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
  enum class Kind { handle, current, next, waits, drops, toCome, done };
  struct Row {
    ElementId element = 0, sponsor = no_element;
    Kind kind = Kind::handle;
    bool moved = true;
  };

  /// Number of elements of the handle and of steps done.
  std::size_t taken() const { return player_->pass().handle.size() + player_->step(); }
  Row row(int row) const;
  Row waitingRow(std::size_t i) const;
  QString text(const Row& row, int column) const;
  QColor colour(const Row& row) const;

  const PassPlayer* player_ = nullptr;
  std::vector<std::uint32_t> waiting_;  // candidates, or rows of the trace if the list is not known
  std::size_t next_ = 0;                // index of the first candidate that will not be dropped
  std::size_t highest_ = 1;
};

/// The pass of one panel in the Propagation dock: its current step and its waiting list.
class PropagationColumn : public QWidget {
  Q_OBJECT

 public:
  PropagationColumn(Document& document, Propagation& propagation, int panel);

  /// Shows the current step of the pass.
  void refresh();

 protected:
  void changeEvent(QEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void fitSections();
  void showTitle();
  void makeList();
  void arrange();
  QString describe(const PassPlayer& player) const;

  Document& document_;
  Propagation& propagation_;
  int panel_;
  QLabel* title_;
  QRadioButton* choice_;
  QSlider* slider_;
  QLabel* state_;
  QTreeView* list_;
  WaitingListModel model_;
};

}  // namespace chainmail
