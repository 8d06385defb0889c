#include "io/pictures.h"

#include <QBuffer>
#include <QPainter>
#include <QPdfWriter>
#include <QRegularExpression>
#include <QSvgGenerator>
#include <QWidget>
#include <functional>
#include <optional>

#include "common/as_path.h"
#include "common/colours.h"
#include "mesh/error.h"
#include "panels/legend.h"
#include "panels/panel.h"
#include "panels/panel_area.h"

namespace chainmail {
namespace {

constexpr double pointsPerPixel = 72.0 / screenDpi;

/// Throws Error if there is no memory for the picture.
QImage emptyPicture(QSize size, double pixelRatio) {
  QImage image((QSizeF(size) * pixelRatio).toSize(), QImage::Format_ARGB32_Premultiplied);
  if (image.isNull()) {
    throw Error("picture", "there is not enough memory for so many pixels", "choose a smaller scale");
  }
  image.setDevicePixelRatio(pixelRatio);
  return image;
}

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

/// Draws a figure with views in pixels: a surface of many faces would be too large as vector graphics.
QImage figureOf(const QWidget& widget, double scale, bool transparent,
                const std::function<void(QPainter&, const QColor&, double)>& draw) {
  const colours::OnGround light(colours::Ground::light);
  const double pixelRatio = widget.devicePixelRatioF() * scale;
  QImage image = emptyPicture(widget.size(), pixelRatio);
  image.fill(transparent ? Qt::transparent : Qt::white);
  QPainter painter(&image);
  painter.setRenderHint(QPainter::TextAntialiasing);
  draw(painter, transparent ? QColor(Qt::transparent) : QColor(Qt::white), pixelRatio);
  return image;
}

void drawPanels(QPainter& painter, PanelArea& area, const QColor& ground, std::optional<double> pixelRatio) {
  const Legend& legend = area.legend();
  if (legend.isVisibleTo(&area)) {
    painter.fillRect(legend.geometry(), ground);
    painter.setPen(QColor(colours::marked));
    painter.setFont(legend.font());
    painter.save();
    painter.translate(legend.pos());
    legend.draw(painter);
    painter.restore();
  }
  for (const int one : area.inSight()) {
    Panel& panel = *area.panels()[std::size_t(one)];
    painter.save();
    painter.translate(panel.mapTo(&area, QPoint()));
    panel.drawIn(painter, ground, pixelRatio, !legend.isVisibleTo(&area));
    painter.restore();
  }
}

/// Returns the width on paper (mm).
double millimetresOf(const Drawing& drawing) {
  return drawing.millimetres > 0 ? drawing.millimetres : drawing.size.width() * millimetresPerInch / screenDpi;
}

QByteArray asSvg(const Drawing& drawing) {
  QBuffer buffer;
  QSvgGenerator svg;
  svg.setOutputDevice(&buffer);
  svg.setResolution(screenDpi);
  svg.setSize(drawing.size);
  svg.setViewBox(QRect(QPoint(), drawing.size));
  svg.setTitle(drawing.title);
  QPainter(&svg).drawPicture(0, 0, drawing.picture);
  if (drawing.millimetres == 0) {
    return buffer.data();
  }
  // The generator takes only whole dots per inch.
  static const QRegularExpression size(QStringLiteral(R"(width="[^"]*mm" height="[^"]*mm")"));
  QString text = QString::fromUtf8(buffer.data());
  const qsizetype at = text.indexOf(size);
  if (at < 0) {
    return buffer.data();
  }
  const double height = drawing.millimetres * drawing.size.height() / drawing.size.width();
  return text
      .replace(at, size.match(text).capturedLength(),
               QStringLiteral(R"(width="%1mm" height="%2mm")").arg(drawing.millimetres).arg(height))
      .toUtf8();
}

QByteArray asPdf(const Drawing& drawing) {
  QBuffer buffer;
  buffer.open(QIODevice::WriteOnly);
  {
    QPdfWriter pdf(&buffer);
    pdf.setTitle(drawing.title);
    pdf.setResolution(screenDpi);
    const double larger = millimetresOf(drawing) / millimetresPerInch * screenDpi / drawing.size.width();
    pdf.setPageLayout(
        {QPageSize(QSizeF(drawing.size) * larger * pointsPerPixel, QPageSize::Point), QPageLayout::Portrait, {}});
    QPainter painter(&pdf);
    painter.scale(larger, larger);
    painter.drawPicture(0, 0, drawing.picture);
  }
  return buffer.data();
}

}  // namespace

QImage pictureOf(QWidget& widget, double scale, bool transparent) {
  const double pixelRatio = widget.devicePixelRatioF() * scale;
  QImage image = emptyPicture(widget.size(), pixelRatio);
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

QImage figureOf(PanelArea& area, double scale, bool transparent) {
  return figureOf(area, scale, transparent, [&](QPainter& painter, const QColor& ground, double pixelRatio) {
    drawPanels(painter, area, ground, pixelRatio);
  });
}

QImage figureOf(Panel& panel, double scale, bool transparent) {
  return figureOf(panel, scale, transparent, [&](QPainter& painter, const QColor& ground, double pixelRatio) {
    panel.drawIn(painter, ground, pixelRatio);
  });
}

Drawing drawingOf(PanelArea& area, bool transparent) {
  return drawingOf(area.size(), transparent,
                   [&](QPainter& painter, const QColor& ground) { drawPanels(painter, area, ground, std::nullopt); });
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
