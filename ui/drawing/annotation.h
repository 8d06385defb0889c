#pragma once

#include <QFontMetricsF>
#include <QLineF>
#include <QSizeF>
#include <QString>

namespace chainmail {

/// A line over the object of a view, and the words at its middle (logical pixels).
struct Annotation {
  QLineF line;
  QString words;
};

/// The ground of its words: beside the line, inside the view.
QRectF annotationBox(const Annotation& annotation, const QFontMetricsF& font, QSizeF view);
inline constexpr double annotationPadding = 4;      // pixels between the words and the edge of their ground
inline constexpr double annotationEndDiameter = 9;  // pixels, of the rings at the line's ends

}  // namespace chainmail
