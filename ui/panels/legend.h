#pragma once

#include <QWidget>
#include <vector>

#include "panels/colouring.h"
#include "panels/overlay.h"

namespace chainmail {

/// Explains the colours of a panel, or of all panels: title, unit, the colour map, and values along it. It is above the
/// views and not on them, so that it never hides an object.
class Legend : public QWidget {
  Q_OBJECT

 public:
  /// What it shows: everything, only its title, or nothing, because a legend for all panels shows the rest.
  enum class Part { whole, title, nothing };
  /// A value along the colour map.
  struct Tick {
    double share = 0;  // of the map, from 0 to 1
    QString number;
  };

  Legend();
  /// Takes the current colours of a panel.
  void follow(const Colouring& colouring, int panel);
  /// Takes the colours of an overlay instead.
  void show(const OverlayLegend& legend);
  /// Takes the colours of another legend, with its own title.
  void take(const Legend& other, const QString& title);
  void setPart(Part part);
  /// True if there are colours to explain, whatever part of the legend is visible.
  bool isWanted() const { return wanted_; }
  /// True if both legends explain one scale that all panels share. Their numbers may be of different moments.
  bool sharesScaleWith(const Legend& other) const;

  /// Draws the whole legend with the painter's pen and font, in the width of this widget.
  void draw(QPainter& painter) const;
  /// Returns the height of the whole legend.
  int wholeHeight() const;
  /// The texts of the legend; the numbers are empty while there are no values.
  QString title() const { return title_; }
  QString lowest() const;
  QString highest() const;
  /// Returns the values that a map of this width (pixels) shows: both ends, and round values that leave room between
  /// the numbers. No number is shortened.
  std::vector<Tick> ticks(int width) const;

 protected:
  void changeEvent(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  void fit();
  void set(const QString& title, const ColourScale& scale);
  bool showsOne() const {
    return scale_.highest <= (scale_.diverging ? scale_.centre + scale_.threshold : scale_.lowest);
  }
  void drawNeutral(QPainter& painter, QRect& line) const;
  void drawMap(QPainter& painter, QRect line) const;

  QString title_;
  ColourScale scale_;
  Part part_ = Part::whole;
  bool wanted_ = false, shared_ = false, ofOverlay_ = false;
};

}  // namespace chainmail
