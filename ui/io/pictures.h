#pragma once

#include <QImage>
#include <QPicture>
#include <QString>

class QWidget;

namespace chainmail {

class Panel;
class PanelArea;
class View;

/// A widget as the screen shows it, with `scale` times as many pixels to each side, drawn anew so that lines and words
/// are sharp. Transparent, without its ground and those of the views. Throws Error where it is larger than the graphics
/// card can draw.
QImage pictureOf(QWidget& widget, double scale = 1, bool transparent = false);

/// What is drawn in lines, areas and words, for paper: its size is that of the screen (logical pixels).
struct Drawing {
  QPicture picture;
  QSize size;
  QString title;
};
/// Of all panels in sight, of one, or of its object alone; transparent, without a ground.
Drawing drawingOf(PanelArea& area, bool transparent);
Drawing drawingOf(Panel& panel, bool transparent);
Drawing drawingOf(View& view, bool transparent);

/// Whether a path's ending is that of a drawing.
bool isDrawing(const QString& path);
/// Writes a whole file or none, on any thread; PNG, or for drawings SVG or PDF by the path's ending. Throws Error.
void writePicture(const QString& path, const QImage& image);
void writeDrawing(const QString& path, const Drawing& drawing);

}  // namespace chainmail
