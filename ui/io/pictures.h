#pragma once

#include <QImage>
#include <QPicture>
#include <QString>

class QWidget;

namespace chainmail {

class Panel;
class PanelArea;
class View;

inline constexpr int screenDpi = 96;  // of logical pixels
inline constexpr double millimetresPerInch = 25.4;

/// Returns a picture of a widget with `scale` times as many pixels per side as on the screen. Lines and text are drawn
/// again, so they are sharp. A transparent picture has no background. Throws Error if the picture is too large for the
/// memory or the graphics card.
QImage pictureOf(QWidget& widget, double scale = 1, bool transparent = false);

/// Returns a picture of all visible panels, or of one, as a figure for a paper or a slide: on white, without buttons
/// and boxes. Otherwise like pictureOf().
QImage figureOf(PanelArea& area, double scale, bool transparent);
QImage figureOf(Panel& panel, double scale, bool transparent);

/// A vector drawing for print. Its size is the size on the screen, in logical pixels.
struct Drawing {
  QPicture picture;
  QSize size;
  QString title;
  double millimetres = 0;  // width on paper; 0: that of the screen
};
/// Returns the drawing of all visible panels, of one panel, or of its object only; transparent: without a background.
Drawing drawingOf(PanelArea& area, bool transparent);
Drawing drawingOf(Panel& panel, bool transparent);
Drawing drawingOf(View& view, bool transparent);

/// True if a path ends in .svg or .pdf.
bool isDrawing(const QString& path);
/// Writes a PNG, or a drawing as SVG or PDF, by the extension of the path, completely or not at all. Can run on any
/// thread. Throws Error.
void writePicture(const QString& path, const QImage& image);
void writeDrawing(const QString& path, const Drawing& drawing);

}  // namespace chainmail
