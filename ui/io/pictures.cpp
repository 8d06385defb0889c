#include "io/pictures.h"

#include <QBuffer>
#include <QPainter>
#include <QPdfWriter>
#include <QSvgGenerator>
#include <QWidget>

#include "common/colours.h"
#include "common/write_bytes.h"
#include "mesh/error.h"
#include "panels/panel.h"
#include "panels/panel_area.h"

namespace chainmail {
namespace {

constexpr int dotsPerInch = 96;  // logical pixels
constexpr double pointsPerPixel = 72.0 / dotsPerInch;

/// Returns the region of a widget inside `root` that siblings above it or above its parents cover, in the coordinates
/// of the widget.
QRegion coveredBy(const QWidget& widget, const QWidget& root) {
  QRegion covered;
  for (const QWidget* one = &widget; one != &root; one = one->parentWidget()) {
    bool above = false;
    for (const QObject* child : one->parentWidget()->children()) {
      const auto* sibling = qobject_cast<const QWidget*>(child);
      if (above && sibling != nullptr && sibling->isVisible() && !sibling->isWindow()) {
        covered += sibling->geometry().translated(-one->pos() - widget.mapTo(one, QPoint()));
      }
      above = above || child == one;
    }
  }
  return covered;
}

/// Draws a view with its own renderer. QWidget::render would only enlarge the screen's pixels.
void drawView(QPainter& painter, View& view, QWidget& root, double pixelRatio, bool transparent) {
  const QPoint at = &view == &root ? QPoint() : view.mapTo(&root, QPoint());
  const QImage picture = view.picture(pixelRatio, transparent);
  painter.setClipRegion((QRegion(view.rect()) - coveredBy(view, root)).translated(at));
  painter.drawImage(at, picture);
}

/// Draws on white, in any theme.
Drawing drawingOf(QSize size, bool transparent, const std::function<void(QPainter&, const QColor&)>& draw) {
  const colours::OnGround light(colours::Ground::light);
  Drawing drawing{QPicture(), size, QStringLiteral("ChainMail workbench")};
  QPainter painter(&drawing.picture);
  draw(painter, transparent ? QColor(255, 255, 255, 0) : QColor(Qt::white));
  return drawing;
}

QByteArray asSvg(const Drawing& drawing) {
  QBuffer buffer;
  QSvgGenerator svg;
  svg.setOutputDevice(&buffer);
  svg.setResolution(dotsPerInch);
  svg.setSize(drawing.size);
  svg.setViewBox(QRect(QPoint(), drawing.size));
  svg.setTitle(drawing.title);
  QPainter(&svg).drawPicture(0, 0, drawing.picture);
  return buffer.data();
}

QByteArray asPdf(const Drawing& drawing) {
  QBuffer buffer;
  buffer.open(QIODevice::WriteOnly);
  {
    QPdfWriter pdf(&buffer);
    pdf.setTitle(drawing.title);
    pdf.setResolution(dotsPerInch);
    pdf.setPageLayout({QPageSize(QSizeF(drawing.size) * pointsPerPixel, QPageSize::Point), QPageLayout::Portrait, {}});
    QPainter(&pdf).drawPicture(0, 0, drawing.picture);
  }
  return buffer.data();
}

}  // namespace

QImage pictureOf(QWidget& widget, double scale, bool transparent) {
  const double pixelRatio = widget.devicePixelRatioF() * scale;
  QImage image((QSizeF(widget.size()) * pixelRatio).toSize(), QImage::Format_ARGB32_Premultiplied);
  if (image.isNull()) {
    throw Error("picture", "there is not enough memory for so many pixels", "choose a smaller scale");
  }
  image.setDevicePixelRatio(pixelRatio);
  image.fill(Qt::transparent);
  widget.render(&image, {}, {},
                transparent ? QWidget::DrawChildren : QWidget::DrawChildren | QWidget::DrawWindowBackground);
  QPainter painter(&image);
  painter.setCompositionMode(QPainter::CompositionMode_Source);
  auto views = widget.findChildren<View*>();
  if (auto* itself = qobject_cast<View*>(&widget)) {
    views << itself;
  }
  for (View* view : views) {
    if (view->isVisible()) {
      drawView(painter, *view, widget, pixelRatio, transparent);
    }
  }
  return image;
}

Drawing drawingOf(PanelArea& area, bool transparent) {
  return drawingOf(area.size(), transparent, [&](QPainter& painter, const QColor& ground) {
    for (const int one : area.inSight()) {
      Panel& panel = *area.panels()[std::size_t(one)];
      painter.save();
      painter.translate(panel.mapTo(&area, QPoint()));
      panel.drawIn(painter, ground);
      painter.restore();
    }
  });
}

Drawing drawingOf(Panel& panel, bool transparent) {
  return drawingOf(panel.size(), transparent,
                   [&](QPainter& painter, const QColor& ground) { panel.drawIn(painter, ground); });
}

Drawing drawingOf(View& view, bool transparent) {
  return drawingOf(view.size(), transparent,
                   [&](QPainter& painter, const QColor& ground) { view.drawIn(painter, ground); });
}

bool isDrawing(const QString& path) {
  return path.endsWith(QStringLiteral(".svg"), Qt::CaseInsensitive) ||
         path.endsWith(QStringLiteral(".pdf"), Qt::CaseInsensitive);
}

void writePicture(const QString& path, const QImage& image) {
  QBuffer buffer;
  buffer.open(QIODevice::WriteOnly);
  writeBytes(path, image.save(&buffer, "PNG") ? buffer.data() : QByteArray());
}

void writeDrawing(const QString& path, const Drawing& drawing) {
  const bool svg = path.endsWith(QStringLiteral(".svg"), Qt::CaseInsensitive);
  writeBytes(path, svg ? asSvg(drawing) : asPdf(drawing));
}

}  // namespace chainmail
