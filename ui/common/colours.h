#pragma once

#include <QColor>
#include <array>
#include <functional>

class QWidget;

/// Every colour that is not the palette's. The marks are told apart by the colour-blind (Okabe and Ito 2008) on either
/// ground, and stand out from it by a contrast of at least 3 (WCAG 2.1, 1.4.11); words by 4.5.
namespace chainmail::colours {

/// What the window's words and marks stand on.
enum class Ground { dark, light };

/// That of the application's palette, as it is now.
Ground ground();

/// As long as it lives, the ground is this one whatever the palette: what is drawn meanwhile is for paper.
class OnGround {
 public:
  explicit OnGround(Ground ground);
  ~OnGround();
  OnGround(const OnGround&) = delete;
  OnGround& operator=(const OnGround&) = delete;
};

/// A colour for either ground. Where a QColor is asked for it is that of the present ground: who keeps one keeps this,
/// or asks again when the theme changes (followTheme).
class Colour {
 public:
  constexpr Colour(QRgb onDark, QRgb onLight) : onDark_(onDark), onLight_(onLight) {}
  QColor on(Ground ground) const { return QColor::fromRgb(ground == Ground::dark ? onDark_ : onLight_); }
  operator QColor() const { return on(ground()); }

 private:
  QRgb onDark_, onLight_;
};

// The views'.
inline constexpr Colour background(0xff15191f, 0xfff8f9fb);
inline constexpr Colour left(0xffe69f00, 0xff9c4a00);
inline constexpr Colour right(0xff56b4e9, 0xff0068a8);
inline constexpr Colour third(0xff00a87a, 0xff006b50);
inline constexpr Colour fourth(0xffac78ff, 0xff7028b8);
inline constexpr Colour marked(0xffffffff, 0xff101418);
inline constexpr Colour pinned(0xfff0e442, 0xff6a5a00);
inline constexpr Colour selected(0xfff5a6d0, 0xffb02a80);
inline constexpr Colour focus(0xff56b4e9, 0xff0068a8);  // the frame of where the keys go
inline constexpr Colour lit(0xfff05030, 0xffcc2200);
inline constexpr Colour inside(0xff2fc49b, 0xff00754f);  // a valid region
inline constexpr Colour outside(0xfff07a30, 0xffb84800);

// The message bar's: what it stands on, and what its sign is drawn in. Its words are the palette's.
inline constexpr Colour infoGround(0xff1d3a52, 0xffdcecf8);
inline constexpr Colour warningGround(0xff4a3a12, 0xfffbeec4);
inline constexpr Colour errorGround(0xff5a2a1e, 0xfffbdcd4);
inline constexpr Colour infoSign(0xff8ccbf2, 0xff0068a8);
inline constexpr Colour warningSign(0xfff0c84a, 0xff7a5800);
inline constexpr Colour errorSign(0xffff9a80, 0xffb32000);

// Of tool buttons.
inline constexpr Colour checked(0xff1f5f8b, 0xffb8dcf2);
inline constexpr Colour checkedEdge(0xff3f93cb, 0xff4a90c0);

/// The same colour further from the ground, for what stands out among its like.
QColor stronger(const QColor& colour);
/// The same colour near the ground, for the faces between links of that colour.
QColor faint(const QColor& colour);

/// The same for faces that stand for themselves, and for those that a section lays open.
QColor solid(const QColor& colour);
QColor bright(const QColor& colour);

/// Of a panel and all that speaks of it, by its number from 0.
inline constexpr Colour ofPanel(int panel) { return std::array{left, right, third, fourth}[std::size_t(panel)]; }

}  // namespace chainmail::colours

namespace chainmail {

/// Does `apply` now, and again whenever the theme has changed, as long as the widget lives.
void followTheme(QWidget& widget, std::function<void()> apply);

}  // namespace chainmail
