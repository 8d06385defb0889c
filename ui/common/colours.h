#pragma once

#include <QColor>
#include <array>
#include <functional>

class QWidget;

/// All colours that are neither in the palette nor in the table of algorithms (solver/algorithms.cpp). Colour-blind
/// users can distinguish the marks (Okabe and Ito 2008) on both grounds. The contrast to the ground is at least 3 for
/// marks (WCAG 2.1, 1.4.11) and 4.5 for text.
namespace chainmail::colours {

/// The background of text and marks.
enum class Ground { dark, light };

/// Returns the ground of the application's current palette.
Ground ground();

/// Overrides the ground while this object exists, whatever the palette is; used for printed pictures.
class OnGround {
 public:
  explicit OnGround(Ground ground);
  ~OnGround();
  OnGround(const OnGround&) = delete;
  OnGround& operator=(const OnGround&) = delete;
};

/// A colour with a variant for each ground. It converts to the QColor of the current ground. Store the Colour and not
/// the QColor, or convert again when the theme changes (followTheme).
class Colour {
 public:
  constexpr Colour(QRgb onDark, QRgb onLight) : onDark_(onDark), onLight_(onLight) {}
  QColor on(Ground ground) const { return QColor::fromRgb(ground == Ground::dark ? onDark_ : onLight_); }
  operator QColor() const { return on(ground()); }

 private:
  QRgb onDark_, onLight_;
};

// Views.
inline constexpr Colour background(0xff15191f, 0xfff8f9fb);
inline constexpr Colour marked(0xffffffff, 0xff101418);
inline constexpr Colour pinned(0xff56e8ff, 0xff006a78);  // unlike all colours of the colour map
inline constexpr Colour selected(0xfff5a6d0, 0xffb02a80);
inline constexpr Colour focus(0xff56b4e9, 0xff0068a8);  // the frame of the view with the keyboard focus
inline constexpr Colour lit(0xfff05030, 0xffcc2200);
inline constexpr Colour inside(0xff2fc49b, 0xff00754f);  // a valid region
inline constexpr Colour outside(0xfff07a30, 0xffb84800);
inline constexpr Colour inner(0xfff3ead6, 0xffc4b596);  // the inside of a volume, where a cut or a section shows it

// The message bar: background and sign. Its text has the colour of the palette.
inline constexpr Colour infoGround(0xff1d3a52, 0xffdcecf8);
inline constexpr Colour warningGround(0xff4a3a12, 0xfffbeec4);
inline constexpr Colour errorGround(0xff5a2a1e, 0xfffbdcd4);
inline constexpr Colour infoSign(0xff8ccbf2, 0xff0068a8);
inline constexpr Colour warningSign(0xfff0c84a, 0xff7a5800);
inline constexpr Colour errorSign(0xffff9a80, 0xffb32000);

// Checked tool buttons.
inline constexpr Colour checked(0xff1f5f8b, 0xffb8dcf2);
inline constexpr Colour checkedEdge(0xff3f93cb, 0xff4a90c0);

/// Returns the contrast ratio of two colours, from 1 to 21 (WCAG 2.1).
double contrast(const QColor& one, const QColor& other);

/// Returns a variant of the colour with more contrast to the ground, which highlights one item among others of that
/// colour.
QColor stronger(const QColor& colour);
/// Returns a variant with little contrast to the ground, for the faces between links of that colour.
QColor faint(const QColor& colour);

/// Like faint(), with more contrast, for faces in a plane without links.
QColor solid(const QColor& colour);
/// Returns a light variant, for surfaces in space, whose shadows must stay distinguishable from the ground.
QColor light(const QColor& colour);
/// Returns a dark variant, for thin lines on a light surface of that colour.
QColor edge(const QColor& colour);

}  // namespace chainmail::colours

namespace chainmail {

/// Calls `apply` now and after each change of the theme, while the widget exists.
void followTheme(QWidget& widget, std::function<void()> apply);

}  // namespace chainmail
