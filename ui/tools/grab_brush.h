#pragma once

#include <QObject>
#include <algorithm>
#include <cstddef>

namespace chainmail {

/// The brush of the Drag tool: a press grabs all elements within its radius. The wheel changes the radius while `R` is
/// held. Without a radius, a press grabs one element.
class GrabBrush : public QObject {
  Q_OBJECT

 public:
  static constexpr double largestRadius = 300;  // logical pixels

  GrabBrush();
  ~GrabBrush() override;

  /// Returns the radius (logical pixels); 0 for one element.
  int radius() const;
  bool keyHeld() const { return keyHeld_; }
  /// Changes the radius by notches of the wheel.
  void turn(double notches);
  void setNotches(double notches);
  /// Number of elements that a press would grab.
  std::size_t reached() const { return reached_; }
  void setReached(std::size_t elements);

 signals:
  /// The radius or the number of elements has changed.
  void changed();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  double notches_ = 0;  // of the wheel, since the radius was 0
  std::size_t reached_ = 0;
  bool keyHeld_ = false;
};

}  // namespace chainmail
