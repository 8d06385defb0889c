#include "common/colours.h"

#include <QEvent>
#include <QGuiApplication>
#include <QPalette>
#include <QWidget>
#include <algorithm>
#include <cmath>
#include <optional>

namespace chainmail {
namespace {

constexpr int strongerPercent = 125;
constexpr int middleLightness = 128;

/// Watches for palette changes, and calls `apply` when the ground has changed.
class ThemeFollower : public QObject {
 public:
  ThemeFollower(QWidget& widget, std::function<void()> apply)
      : QObject(&widget), apply_(std::move(apply)), ground_(colours::ground()) {
    widget.installEventFilter(this);
    apply_();
  }

  bool eventFilter(QObject* /*watched*/, QEvent* event) override {
    const bool palette = event->type() == QEvent::PaletteChange || event->type() == QEvent::ApplicationPaletteChange;
    if (palette && colours::ground() != ground_) {
      ground_ = colours::ground();  // first, because `apply` may change the palette of the widget
      apply_();
    }
    return false;
  }

 private:
  std::function<void()> apply_;
  colours::Ground ground_;
};

}  // namespace

namespace colours {

namespace {

std::optional<Ground> forced;  // set by OnGround, of which there is at most one; used by the GUI thread only

}  // namespace

OnGround::OnGround(Ground ground) { forced = ground; }
OnGround::~OnGround() { forced.reset(); }

Ground ground() {
  if (forced) {
    return *forced;
  }
  const int lightness = QGuiApplication::palette().color(QPalette::Window).lightness();
  return lightness < middleLightness ? Ground::dark : Ground::light;
}

namespace {

double luminance(const QColor& colour) {
  const auto linear = [](double channel) {
    return channel <= 0.04045 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(colour.redF()) + 0.7152 * linear(colour.greenF()) + 0.0722 * linear(colour.blueF());
}

}  // namespace

double contrast(const QColor& one, const QColor& other) {
  const auto [low, high] = std::minmax({luminance(one), luminance(other)});
  return (high + 0.05) / (low + 0.05);
}

QColor stronger(const QColor& colour) {
  return ground() == Ground::dark ? colour.lighter(strongerPercent) : colour.darker(strongerPercent);
}

namespace {

/// Returns the colour darkened (percent, as QColor::darker) on a dark ground. On a light ground, mixes it with the
/// background; `own` is the share of the colour itself, from 0 to 1.
QColor nearer(const QColor& colour, int darker, double own) {
  if (ground() == Ground::dark) {
    return colour.darker(darker);
  }
  const QColor behind = background;
  const auto mixed = [own](float of, float with) { return float(with + own * (of - with)); };
  return QColor::fromRgbF(mixed(colour.redF(), behind.redF()), mixed(colour.greenF(), behind.greenF()),
                          mixed(colour.blueF(), behind.blueF()));
}

}  // namespace

QColor faint(const QColor& colour) { return nearer(colour, 320, 0.22); }
QColor solid(const QColor& colour) { return nearer(colour, 190, 0.6); }

QColor light(const QColor& colour) {
  const double white = ground() == Ground::dark ? 0.45 : 0.55;
  const auto mixed = [white](float channel) { return float(channel + white * (1 - channel)); };
  return QColor::fromRgbF(mixed(colour.redF()), mixed(colour.greenF()), mixed(colour.blueF()));
}

QColor edge(const QColor& colour) { return colour.darker(ground() == Ground::dark ? 400 : 230); }

}  // namespace colours

void followTheme(QWidget& widget, std::function<void()> apply) { new ThemeFollower(widget, std::move(apply)); }

}  // namespace chainmail
