#include "common/plot_pictures.h"

#include <QBuffer>
#include <QFontInfo>
#include <QImage>
#include <QPainter>
#include <QPdfWriter>
#include <QSvgRenderer>
#include <sstream>

#include "common/as_path.h"
#include "common/colours.h"
#include "common/text.h"
#include "common/theme.h"

namespace chainmail {
namespace {

constexpr double leastContrast = 3;  // contrast of marks with the background (WCAG 2.1, 1.4.11)
constexpr double mmPerInch = 25.4, pointsPerInch = 72, pixelsPerInch = 96;
constexpr double savedFont = 8;  // points, the usual size in the figures of a paper

QColor mixed(const QColor& one, const QColor& other, double share) {
  const auto mix = [share](double a, double b) { return float(a + share * (b - a)); };
  return QColor::fromRgbF(mix(one.redF(), other.redF()), mix(one.greenF(), other.greenF()),
                          mix(one.blueF(), other.blueF()));
}

/// Returns a colour, mixed with the text colour until it has enough contrast to the background.
std::string standingOut(QColor colour, const QColor& ink, const QColor& ground) {
  for (int step = 0; step < 10 && colours::contrast(colour, ground) < leastContrast; ++step) {
    colour = mixed(colour, ink, 0.1);
  }
  return colour.name().toStdString();
}

report::SvgStyle savedStyle(const PlotSize& size) {
  const QPalette palette = paletteOn(colours::Ground::light);
  report::SvgStyle style = plotStyle(palette, {});
  style.width = size.widthMm / mmPerInch * pixelsPerInch;
  style.height = size.heightMm / mmPerInch * pixelsPerInch;
  style.ground = palette.color(QPalette::Base).name().toStdString();
  style.font = "sans-serif";
  style.font_size = savedFont / pointsPerInch * pixelsPerInch;
  return style;
}

bool paintPlot(QPaintDevice& device, const QByteArray& drawing) {
  QPainter painter;
  if (!painter.begin(&device)) {
    return false;
  }
  painter.setRenderHint(QPainter::Antialiasing);
  QSvgRenderer(drawing).render(&painter, QRectF(0, 0, device.width(), device.height()));
  return painter.end();
}

QByteArray pdfOf(const QByteArray& drawing, const QString& title, const PlotSize& size) {
  QBuffer buffer;
  buffer.open(QIODevice::WriteOnly);
  QPdfWriter writer(&buffer);
  writer.setPageSize(QPageSize({size.widthMm, size.heightMm}, QPageSize::Millimeter));
  writer.setPageMargins({});
  writer.setTitle(title);
  return paintPlot(writer, drawing) ? buffer.data() : QByteArray();
}

QByteArray pngOf(const QByteArray& drawing, const PlotSize& size) {
  QImage image((QSizeF(size.widthMm, size.heightMm) * (size.dotsPerInch / mmPerInch)).toSize(), QImage::Format_RGB32);
  image.setDotsPerMeterX(qRound(1000 * size.dotsPerInch / mmPerInch));
  image.setDotsPerMeterY(image.dotsPerMeterX());
  QBuffer buffer;
  buffer.open(QIODevice::WriteOnly);
  return !image.isNull() && paintPlot(image, drawing) && image.save(&buffer, "PNG") ? buffer.data() : QByteArray();
}

}  // namespace

report::SvgStyle plotStyle(const QPalette& palette, const QFont& font) {
  const QColor ink = palette.color(QPalette::WindowText), ground = palette.color(QPalette::Window);
  report::SvgStyle style{.ink = ink.name().toStdString()};
  style.font = font.family().toStdString();
  style.font_size = QFontInfo(font).pixelSize();
  style.adapt = [ink, ground](std::string_view colour) { return standingOut(QColor(text(colour)), ink, ground); };
  return style;
}

QByteArray plotDrawing(const report::Plot& plot, const report::SvgStyle& style) {
  std::ostringstream out;
  report::write_svg(out, plot, style);
  return QByteArray::fromStdString(out.str());
}

QPixmap plotMark(Algorithm algorithm, bool hollow, int size, double devicePixelRatio, const QPalette& palette) {
  QPixmap picture(QSize(size, size) * devicePixelRatio);
  picture.fill(Qt::transparent);
  paintPlot(picture,
            QByteArray::fromStdString(report::mark_svg(report::style_of(algorithm), hollow, plotStyle(palette, {}))));
  picture.setDevicePixelRatio(devicePixelRatio);
  return picture;
}

QStringList plotFilters() {
  return {QStringLiteral("SVG drawing (*.svg)"), QStringLiteral("PDF drawing (*.pdf)"),
          QStringLiteral("PNG picture (*.png)")};
}

void savePlot(const report::Plot& plot, const QString& path, const PlotSize& size) {
  const auto endsIn = [&path](const char* ending) { return path.endsWith(QLatin1String(ending), Qt::CaseInsensitive); };
  const QByteArray drawing = plotDrawing(plot, savedStyle(size));
  writeBytes(path, endsIn(".svg")   ? drawing
                   : endsIn(".pdf") ? pdfOf(drawing, text(plot.title), size)
                                    : pngOf(drawing, size));
}

}  // namespace chainmail
