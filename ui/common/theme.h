#pragma once

#include <QApplication>
#include <QPalette>
#include <QProxyStyle>
#include <QString>
#include <QWidget>

#include "common/colours.h"

namespace chainmail {

/// Returns the ground of the theme that the user chose; dark if none was chosen.
colours::Ground rememberedGround();
void remember(colours::Ground ground);

/// Returns the palette for a ground. The ground may differ from that of the window, for example in a picture.
QPalette paletteOn(colours::Ground ground);
/// Sets the palette of the whole application.
void applyGround(colours::Ground ground);

/// Returns how much larger the texts of a widget are than usual: 1, or more in the lecture mode.
inline double textScale(const QWidget& widget) {
  return widget.font().pointSizeF() / QApplication::font().pointSizeF();
}

/// Returns a length that grows with the texts of a widget (pixels).
inline int scaled(int length, const QWidget& widget) { return qRound(length * textScale(widget)); }

/// The Fusion style with some changes: checked tool buttons look different from unchecked ones, combo boxes open lists,
/// the button that opens the rest of a tool bar is large enough to see, labels show plain text, and docks have bold
/// titles, and a border while they float.
///
/// A style sheet would do the same, but Qt 6.4 visits all widgets to change one, and crashes if a widget is deleted
/// meanwhile.
class WorkbenchStyle : public QProxyStyle {
  Q_OBJECT

 public:
  WorkbenchStyle();
  /// Makes labels, tool tips and questions show their text as it is. A label with rich text sets Qt::RichText when it
  /// is made, and escapes what is not its own (QString::toHtmlEscaped).
  void polish(QWidget* widget) override;
  using QProxyStyle::polish;
  void drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                     const QWidget* widget) const override;
  void drawControl(ControlElement element, const QStyleOption* option, QPainter* painter,
                   const QWidget* widget) const override;
  /// Draws the button that opens the rest of a tool bar, and those of docks, like our other icons: Fusion's are small
  /// and have little contrast.
  QIcon standardIcon(StandardPixmap picture, const QStyleOption* option, const QWidget* widget) const override;
  int pixelMetric(PixelMetric metric, const QStyleOption* option, const QWidget* widget) const override;
  /// Makes combo boxes open lists. Drawn as menus, they would get the background that menus need for visible check
  /// boxes.
  int styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                QStyleHintReturn* answer) const override;
};

}  // namespace chainmail
