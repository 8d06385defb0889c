#pragma once

#include <QProxyStyle>

namespace chainmail {

/// Fusion, but for checked tool buttons, which it hardly tells from unchecked ones, and the lists of combo boxes.
///
/// A style sheet of the application would do too, but Qt 6.4 goes through all widgets to change one, and crashes where
/// one of them goes meanwhile.
class WorkbenchStyle : public QProxyStyle {
  Q_OBJECT

 public:
  WorkbenchStyle();
  void drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                     const QWidget* widget) const override;
  /// Combo boxes open lists: as menus, they would be drawn on the ground that makes boxes in menus visible.
  int styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                QStyleHintReturn* answer) const override;
};

}  // namespace chainmail
