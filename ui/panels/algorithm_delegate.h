#pragma once

#include <QStyledItemDelegate>

namespace chainmail {

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

}  // namespace chainmail
