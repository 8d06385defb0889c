// Tests plots in a widget and in files, with the fonts of the window.

#include <QFile>
#include <QImage>
#include <QPainter>
#include <QSvgRenderer>
#include <QTemporaryDir>

#include "common/plot_widget.h"
#include "common/theme.h"
#include "window.h"

namespace chainmail::window_plot {

namespace {

/// A plot with as many panels, whose marks differ in time and error.
report::Plot plotOf(int panels) {
  report::Plot plot;
  plot.title = "Time against largest violation on an object with a long name";
  plot.x.title = "ms per move";
  plot.y.title = "largest violation (rest lengths)";
  plot.legend_notes = {"hollow: with 10 sweeps per move"};
  for (int i = 0; i < panels; ++i) {
    report::PlotPanel& panel = plot.panels.emplace_back();
    panel.title = "a drag with a name that is long, back and forth";
    for (const Algorithm algorithm : {Algorithm::natural_queue, Algorithm::exact, Algorithm::chainmail_3d}) {
      const double x = 0.002 * double(1 + panel.marks.size() * 30), y = panel.marks.size() == 1 ? 0 : 0.01 * x;
      panel.marks.push_back({x, x / 2, x * 2, y, report::series_of(plot, algorithm), false, "eq.",
                             "mark " + std::to_string(panel.marks.size()) + " of " + std::to_string(i)});
    }
  }
  return plot;
}

/// Returns true if nothing of a drawing is beyond its edge.
bool isInside(const report::Plot& plot, const report::SvgStyle& style) {
  constexpr int around = 60;
  const auto [width, height] = report::PlotLayout(plot, style).size();
  const QRect area(around, around, int(std::ceil(width)), int(std::ceil(height)));
  QImage image(area.size() + 2 * QSize(around, around), QImage::Format_RGB32);
  image.fill(Qt::white);
  const QImage blank = image;
  QPainter painter(&image);
  QSvgRenderer(plotDrawing(plot, style)).render(&painter, QRectF(area.topLeft(), QSizeF(width, height)));
  const bool isDrawn = image != blank;
  painter.fillRect(area.adjusted(-1, -1, 1, 1), Qt::white);
  painter.end();
  return isDrawn && image == blank;
}

QByteArray bytesOfFile(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

}  // namespace

class WindowPlot : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

  void allOfADrawingIsInsideIt() {
    for (const auto parts : {report::PlotParts::whole, report::PlotParts::panels, report::PlotParts::legend}) {
      for (const QSize size : {QSize(200, 150), QSize(333, 227), QSize(700, 300)}) {
        for (const int panels : {1, 2, 3}) {
          report::SvgStyle style = plotStyle(paletteOn(colours::Ground::light), QApplication::font());
          style.width = size.width();
          style.height = size.height();
          style.parts = parts;
          QVERIFY2(
              isInside(plotOf(panels), style),
              qPrintable(QStringLiteral("%1 panels, %2 wide, parts %3").arg(panels).arg(size.width()).arg(int(parts))));
        }
      }
    }
  }

  void thePointerReadsTheMarksOfAllPanels() {
    PlotWidget widget(QStringLiteral("empty"));
    widget.resize(600, 250);
    QVERIFY(widget.readingAt({300, 125}).isEmpty());
    widget.show(plotOf(2));
    QSet<QString> readings;
    for (int x = 0; x < widget.width(); x += 4) {
      for (int y = 0; y < widget.height(); y += 4) {
        readings << widget.readingAt(QPointF(x, y));
      }
    }
    for (const report::PlotPanel& panel : widget.plot().panels) {
      for (const report::PlotMark& mark : panel.marks) {
        QVERIFY2(readings.contains(QString::fromStdString(mark.title)), mark.title.c_str());
      }
    }
    QVERIFY(readings.contains(QString()));
  }

  void aSavedPlotHasItsSizeOnPaper() {
    const QTemporaryDir folder;
    const report::Plot plot = plotOf(1);
    savePlot(plot, folder.filePath(QStringLiteral("a.png")));
    const QImage column(folder.filePath(QStringLiteral("a.png")));
    QCOMPARE(column.size(), QSize(1039, 709));  // 88 mm x 60 mm at 300 dpi
    QCOMPARE(column.dotsPerMeterX(), 11811);
    savePlot(plot, folder.filePath(QStringLiteral("b.png")), {127, 63.5, 100});
    QCOMPARE(QImage(folder.filePath(QStringLiteral("b.png"))).size(), QSize(500, 250));
    savePlot(plot, folder.filePath(QStringLiteral("a.svg")), {127, 63.5, 100});
    const QByteArray svg = bytesOfFile(folder.filePath(QStringLiteral("a.svg")));
    QVERIFY(svg.contains("width=\"480.00\" height=\"240.00\""));  // CSS pixels
    QVERIFY(svg.contains(">ms per move<") && svg.contains(">Natural Queue ChainMail<"));
    savePlot(plot, folder.filePath(QStringLiteral("a.pdf")));
    const QByteArray pdf = bytesOfFile(folder.filePath(QStringLiteral("a.pdf")));
    QVERIFY(pdf.startsWith("%PDF") && pdf.contains("/MediaBox [0 0 249"));  // 88 mm in points
  }
};

CHAINMAIL_WINDOW_TEST(WindowPlot)

}  // namespace chainmail::window_plot

#include "window_plot.moc"
