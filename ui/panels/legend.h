#pragma once

#include <QWidget>

#include "panels/colouring.h"
#include "panels/overlay.h"

namespace chainmail {

/// Explains the colours of a panel: title, unit, the colour map, and the values at its ends. It is above the view and
/// not on it, so that it never hides the object.
class Legend : public QWidget {
  Q_OBJECT

 public:
  Legend();
  /// Shows the current colours of a panel.
  void follow(const Colouring& colouring, int panel);
  /// Shows the colours of an overlay instead.
  void show(const OverlayLegend& legend);
  /// Draws the legend with the painter's pen and font, in the width of this widget.
  void draw(QPainter& painter) const;
  /// The texts of the legend; the numbers are empty while there are no values.
  QString title() const { return title_; }
  QString lowest() const;
  QString highest() const;

 protected:
  void changeEvent(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  void fitHeight();
  void set(const QString& title, const ColourScale& scale);
  bool showsOne() const { return scale_.highest <= (scale_.diverging ? scale_.threshold : scale_.lowest); }
  void drawNeutral(QPainter& painter, QRect& line) const;
  void drawMap(QPainter& painter, QRect line) const;

  QString title_;
  ColourScale scale_;
};

}  // namespace chainmail
