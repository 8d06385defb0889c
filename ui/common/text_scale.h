#pragma once

#include <QApplication>
#include <QWidget>

namespace chainmail {

/// Returns how much larger the texts of a widget are than usual: 1, or more in the lecture mode.
inline double textScale(const QWidget& widget) {
  return widget.font().pointSizeF() / QApplication::font().pointSizeF();
}

/// Returns a length that grows with the texts of a widget (pixels).
inline int scaled(int length, const QWidget& widget) { return qRound(length * textScale(widget)); }

}  // namespace chainmail
