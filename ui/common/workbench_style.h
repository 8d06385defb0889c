#pragma once

#include <QProxyStyle>

namespace chainmail {

/// The Fusion style with two changes: checked tool buttons look different from unchecked ones, and combo boxes open
/// lists.
///
/// A style sheet would do the same, but Qt 6.4 visits all widgets to change one, and crashes if a widget is deleted
/// meanwhile.
class WorkbenchStyle : public QProxyStyle {
  Q_OBJECT

 public:
  WorkbenchStyle();
  void drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                     const QWidget* widget) const override;
  /// Makes combo boxes open lists. Drawn as menus, they would get the background that menus need for visible check
  /// boxes.
  int styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                QStyleHintReturn* answer) const override;
};

}  // namespace chainmail
