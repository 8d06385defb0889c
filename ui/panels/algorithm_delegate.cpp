#include "panels/algorithm_delegate.h"

#include <QApplication>
#include <QPainter>

namespace chainmail {
namespace {

constexpr int margin = 8, padding = 4;  // pixels
constexpr double smaller = 0.88;        // size of the explanation, relative to the name

QFont smallFont(QFont font) {
  font.setPointSizeF(smaller * font.pointSizeF());
  return font;
}

}  // namespace

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

}  // namespace chainmail
