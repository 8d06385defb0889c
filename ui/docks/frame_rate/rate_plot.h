#pragma once

#include <QWidget>
#include <vector>

#include "common/colours.h"
#include "docks/frame_rate/rate_curve.h"

namespace chainmail {

/// The rates of some panels over a stretch of time, as they are drawn.
struct RatePicture {
  struct Curve {
    QString name;
    colours::Colour colour;
    std::vector<QPolygonF> lines;  // s, the quantity's unit
  };

  const RateQuantity* quantity = nullptr;
  double from = 0, to = 1;  // s
  std::vector<Curve> curves;
};

/// Plots rates, a line a panel.
class RatePlot : public QWidget {
  Q_OBJECT

 public:
  RatePlot();
  void show(RatePicture picture);
  const RatePicture& picture() const { return picture_; }
  QSize sizeHint() const override { return {200, 110}; }
  /// What each line says near a place of the plot; empty where there is nothing.
  QString readingAt(QPointF place) const;

 protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  RatePicture picture_;
  QRectF inner_;  // between the axes, as last painted
};

/// Writes a picture with its legend, dark on white: as PDF where the path ends so, else as PNG. Throws Error where that
/// cannot be.
void saveRates(const RatePicture& picture, const QString& path);

}  // namespace chainmail
