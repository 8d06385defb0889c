#pragma once

#include <QWidget>

#include "panels/colouring.h"
#include "panels/overlay.h"

namespace chainmail {

/// Says what the colours of a panel mean: title, unit, the colour map, and the values at its ends. It stands above
/// the view and not on it, so that it never hides the object.
class Legend : public QWidget {
  Q_OBJECT

 public:
  Legend();
  /// Shows what the colours of a panel mean now.
  void follow(const Colouring& colouring, int panel);
  /// Shows what the colours of something over the object mean.
  void show(const OverlayLegend& legend);
  /// Draws it with the painter's pen and font, as wide as it is.
  void draw(QPainter& painter) const;
  /// What it says; the numbers are empty as long as there are none.
  QString title() const { return title_; }
  QString lowest() const;
  QString highest() const;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  bool showsOne() const { return scale_.highest <= (scale_.diverging ? scale_.threshold : scale_.lowest); }
  void drawNeutral(QPainter& painter, QRect& line) const;
  void drawMap(QPainter& painter, QRect line) const;

  QString title_;
  ColourScale scale_;
};

}  // namespace chainmail
