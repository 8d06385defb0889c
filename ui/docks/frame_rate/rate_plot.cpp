#include "docks/frame_rate/rate_plot.h"

#include <QHelpEvent>
#include <QPainter>
#include <QPdfWriter>
#include <QSaveFile>
#include <QToolTip>
#include <array>
#include <cmath>
#include <optional>

#include "common/text.h"
#include "common/theme.h"
#include "mesh/error.h"
#include "report/page/format.h"

namespace chainmail {
namespace {

constexpr QSizeF pageSize{160, 90};      // mm
constexpr QSizeF pictureSize{640, 360};  // logical pixels
constexpr double picturePixelRatio = 3;
constexpr double lineWidth = 1.4;
constexpr int gridColumns = 4;
constexpr double keyWidth = 22, betweenKeys = 16;  // pixels
constexpr double reach = 6;                        // pixels from the cursor in which a point is read

/// The end of an axis from 0: 1, 2 or 5 times a power of ten.
double axisEnd(double highest) {
  if (!(highest > 0)) {
    return 1;
  }
  const double power = std::pow(10, std::floor(std::log10(highest)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (highest <= digit * power) {
      return digit * power;
    }
  }
  return 10 * power;
}

double highestOf(const RatePicture& picture) {
  double highest = 0;
  for (const RatePicture::Curve& curve : picture.curves) {
    for (const QPolygonF& line : curve.lines) {
      for (const QPointF& point : line) {
        highest = std::max(highest, point.y());
      }
    }
  }
  return highest;
}

class Drawing {
 public:
  Drawing(QPainter& painter, const QPalette& palette, colours::Ground ground, const RatePicture& picture)
      : painter_(painter), palette_(palette), ground_(ground), picture_(picture), end_(axisEnd(highestOf(picture))) {}

  void axes(const QRectF& area) {
    const QFontMetricsF metrics(painter_.font(), painter_.device());
    const std::array labels{text(report::figure(0)), text(report::figure(end_ / 2)), text(report::figure(end_))};
    double width = 0;
    for (const QString& label : labels) {
      width = std::max(width, metrics.horizontalAdvance(label));
    }
    inner_ = area.adjusted(width + 6, metrics.height() / 2, -1, -metrics.height() - 3);
    for (int i = 0; i < 3; ++i) {
      const double y = inner_.bottom() - inner_.height() * i / 2;
      grid({inner_.left(), y, inner_.right(), y});
      word({area.left(), y - metrics.height() / 2, width, metrics.height()}, Qt::AlignRight, labels[std::size_t(i)]);
    }
    for (int i = 0; i <= gridColumns; ++i) {
      const double x = inner_.left() + inner_.width() * i / gridColumns;
      grid({x, inner_.top(), x, inner_.bottom()});
    }
    const QRectF below(inner_.left(), inner_.bottom() + 2, inner_.width(), metrics.height());
    word(below, Qt::AlignLeft, QStringLiteral("−%1 s").arg(picture_.to - picture_.from));
    word(below, Qt::AlignRight, QStringLiteral("0 s"));
  }

  const QRectF& inner() const { return inner_; }

  void curves() {
    painter_.save();
    painter_.setClipRect(inner_.adjusted(-1, -1, 1, 1));
    painter_.setRenderHint(QPainter::Antialiasing);
    for (const RatePicture::Curve& curve : picture_.curves) {
      painter_.setPen(QPen(curve.colour.on(ground_), lineWidth, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
      for (QPolygonF line : curve.lines) {
        for (QPointF& point : line) {
          point = place(point);
        }
        line.size() == 1 ? painter_.drawPoint(line.first()) : painter_.drawPolyline(line);
      }
    }
    painter_.restore();
  }

  /// What is plotted, and below it, as many in a line as there is room for, whose the lines are. Returns where it ends.
  double heading(const QRectF& area) {
    const QFontMetricsF metrics(painter_.font(), painter_.device());
    QRectF line(area.left(), area.top(), area.width(), metrics.height() + 3);
    word(line, Qt::AlignLeft,
         QStringLiteral("%1 (%2)").arg(text(picture_.quantity->label), text(picture_.quantity->unit)));
    line.moveTop(line.bottom());
    for (const RatePicture::Curve& curve : picture_.curves) {
      const double width = keyWidth + metrics.horizontalAdvance(curve.name);
      if (line.left() > area.left() && line.left() + width > area.right()) {
        line.moveTopLeft({area.left(), line.bottom()});
      }
      painter_.setPen(QPen(curve.colour.on(ground_), 2 * lineWidth));
      painter_.drawLine(QPointF(line.left(), line.center().y()),
                        QPointF(line.left() + keyWidth - 6, line.center().y()));
      word({line.left() + keyWidth, line.top(), width, line.height()}, Qt::AlignLeft, curve.name);
      line.moveLeft(line.left() + width + betweenKeys);
    }
    return line.bottom();
  }

 private:
  void grid(QLineF line) {
    painter_.setPen(QPen(palette_.color(QPalette::Mid), 0));
    painter_.drawLine(line);
  }
  void word(const QRectF& area, Qt::Alignment alignment, const QString& word) {
    painter_.setPen(palette_.color(QPalette::WindowText));
    painter_.drawText(area, int(alignment | Qt::AlignVCenter) | Qt::TextDontClip | Qt::TextSingleLine, word);
  }
  QPointF place(QPointF point) const {
    return {inner_.left() + inner_.width() * (point.x() - picture_.from) / (picture_.to - picture_.from),
            inner_.bottom() - inner_.height() * point.y() / end_};
  }

  QPainter& painter_;
  const QPalette& palette_;
  colours::Ground ground_;
  const RatePicture& picture_;
  double end_;    // of the upright axis
  QRectF inner_;  // between the axes
};

/// On paper, in an area of the pictures' size.
void drawPage(QPainter& painter, const RatePicture& picture) {
  const QPalette paper = paletteOn(colours::Ground::light);
  QFont font;
  font.setPixelSize(13);
  painter.setFont(font);
  const QRectF area = QRectF({}, pictureSize).adjusted(14, 10, -16, -8);
  Drawing drawing(painter, paper, colours::Ground::light, picture);
  const double below = drawing.heading(area);
  drawing.axes(area.adjusted(0, below - area.top() + 4, 0, 0));
  drawing.curves();
}

bool writePdf(QIODevice& file, const RatePicture& picture) {
  QPdfWriter writer(&file);
  writer.setPageSize(QPageSize(pageSize, QPageSize::Millimeter));
  writer.setPageMargins({});
  writer.setTitle(text(picture.quantity->label));
  QPainter painter;
  if (!painter.begin(&writer)) {
    return false;
  }
  painter.scale(writer.width() / pictureSize.width(), writer.height() / pictureSize.height());
  drawPage(painter, picture);
  return painter.end();
}

bool writePng(QIODevice& file, const RatePicture& picture) {
  QImage image((pictureSize * picturePixelRatio).toSize(), QImage::Format_RGB32);
  image.setDevicePixelRatio(picturePixelRatio);
  image.fill(paletteOn(colours::Ground::light).color(QPalette::Base));
  QPainter painter(&image);
  drawPage(painter, picture);
  painter.end();
  return image.save(&file, "PNG");
}

/// The point of a curve that is nearest in time, if it is within some seconds.
std::optional<QPointF> nearest(const RatePicture::Curve& curve, double time, double within) {
  std::optional<QPointF> found;
  for (const QPolygonF& line : curve.lines) {
    for (const QPointF& point : line) {
      if (const double off = std::abs(point.x() - time); off <= within) {
        within = off;
        found = point;
      }
    }
  }
  return found;
}

}  // namespace

RatePlot::RatePlot() {
  setMinimumHeight(90);
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Expanding);
}

void RatePlot::show(RatePicture picture) {
  picture_ = std::move(picture);
  update();
}

void RatePlot::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  Drawing drawing(painter, palette(), colours::ground(), picture_);
  drawing.axes(rect());
  drawing.curves();
  inner_ = drawing.inner();
}

QString RatePlot::readingAt(QPointF place) const {
  if (!inner_.contains(place)) {
    return {};
  }
  const double seconds = picture_.to - picture_.from;
  const double time = picture_.from + seconds * (place.x() - inner_.left()) / inner_.width();
  QStringList lines;
  for (const RatePicture::Curve& curve : picture_.curves) {
    if (const auto point = nearest(curve, time, reach * seconds / inner_.width())) {
      lines << QStringLiteral("%1: %2 %3")
                   .arg(curve.name, text(report::figure(point->y())), text(picture_.quantity->unit));
    }
  }
  return lines.join(QLatin1Char('\n'));
}

bool RatePlot::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip) {
    const auto* help = dynamic_cast<QHelpEvent*>(event);
    if (const QString reading = readingAt(help->pos()); !reading.isEmpty()) {
      QToolTip::showText(help->globalPos(), reading, this);
      return true;
    }
  }
  return QWidget::event(event);  // what the plot is
}

void saveRates(const RatePicture& picture, const QString& path) {
  QSaveFile file(path);
  const bool asPdf = path.endsWith(QStringLiteral(".pdf"), Qt::CaseInsensitive);
  if (!file.open(QIODevice::WriteOnly) || !(asPdf ? writePdf(file, picture) : writePng(file, picture)) ||
      !file.commit()) {
    throw Error(path.toStdString(), "the picture could not be written (" + file.errorString().toStdString() + ")",
                "choose another place");
  }
}

}  // namespace chainmail
