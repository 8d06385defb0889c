#include "common/icons.h"

#include <QGuiApplication>
#include <QIconEngine>
#include <QPainter>
#include <QPainterPath>
#include <QPalette>
#include <algorithm>
#include <optional>
#include <sstream>

#include "common/icon_drawings.h"

namespace chainmail {
namespace {

constexpr double drawingSide = 16;  // side of a drawing's square, in its units
constexpr double lineWidth = 1.4;

/// Adds one command of a drawing to a path. A test reads all drawings, so the numbers need no check here.
void add(QPainterPath& path, char command, std::istringstream& numbers) {
  const auto next = [&numbers] {
    double number = 0;
    numbers >> number;
    return number;
  };
  const auto point = [&next] {
    const double x = next();
    return QPointF(x, next());
  };
  if (command == 'M') {
    path.moveTo(point());
  } else if (command == 'L') {
    path.lineTo(point());
  } else if (command == 'C') {
    const QPointF first = point(), second = point();
    path.cubicTo(first, second, point());
  } else if (command == 'E') {
    const QPointF centre = point(), radii = point();
    path.addEllipse(centre, radii.x(), radii.y());
  } else if (command == 'R') {
    const QPointF corner = point(), size = point();
    path.addRect(corner.x(), corner.y(), size.x(), size.y());
  } else if (command == 'A') {
    const QPointF centre = point();
    const double radius = next(), start = next();
    const QRectF box(centre - QPointF(radius, radius), QSizeF(2 * radius, 2 * radius));
    path.arcMoveTo(box, start);
    path.arcTo(box, start, next());
  } else {
    path.closeSubpath();
  }
}

QPainterPath pathOf(std::string_view words) {
  std::istringstream numbers{std::string(words)};
  numbers.imbue(std::locale::classic());
  QPainterPath path;
  for (char command = 0; numbers >> command;) {
    add(path, command, numbers);
  }
  return path;
}

QColor colourOf(QIcon::Mode mode) {
  const QPalette palette = QGuiApplication::palette();
  return mode == QIcon::Disabled   ? palette.color(QPalette::Disabled, QPalette::ButtonText)
         : mode == QIcon::Selected ? palette.color(QPalette::HighlightedText)
                                   : palette.color(QPalette::ButtonText);
}

class DrawnIcon : public QIconEngine {
 public:
  DrawnIcon(const IconDrawing& drawing, const std::optional<QColor>& own) : drawing_(drawing), own_(own) {}

  void paint(QPainter* painter, const QRect& rect, QIcon::Mode mode, QIcon::State /*state*/) override {
    const QColor colour = own_.value_or(colourOf(mode));
    const QColor mark = mode == QIcon::Disabled ? colour : QColor(drawing_.mark);
    const double size = std::min(rect.width(), rect.height());
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    painter->translate(QRectF(rect).center() - QPointF(size, size) / 2);
    painter->scale(size / drawingSide, size / drawingSide);
    QPen pen(colour, lineWidth, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin);
    painter->fillPath(pathOf(drawing_.fills), colour);
    painter->fillPath(pathOf(drawing_.marks), mark);
    if (drawing_.dashed) {
      pen.setDashPattern({1.6, 1.8});
    }
    painter->strokePath(pathOf(drawing_.lines), pen);
    painter->strokePath(pathOf(drawing_.markLines), QPen(mark, lineWidth));
    painter->restore();
  }

  QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) override {
    QPixmap picture(size);
    if (picture.isNull()) {
      return picture;  // empty: there is nothing to paint on
    }
    picture.fill(Qt::transparent);
    QPainter painter(&picture);
    paint(&painter, picture.rect(), mode, state);
    return picture;
  }

  QIconEngine* clone() const override { return new DrawnIcon(*this); }
  QString iconName() override { return QString::fromUtf8(drawing_.name.data(), qsizetype(drawing_.name.size())); }

 private:
  IconDrawing drawing_;  // refers to text in the table
  std::optional<QColor> own_;
};

QIcon drawn(const char* name, const std::optional<QColor>& own) {
  const auto all = iconDrawings();
  const auto found = std::ranges::find(all, std::string_view(name), &IconDrawing::name);
  return found == all.end() ? QIcon() : QIcon(new DrawnIcon(*found, own));
}

}  // namespace

QIcon icon(const char* name) { return drawn(name, std::nullopt); }

QIcon icon(const char* name, const QColor& colour) { return drawn(name, colour); }

QStringList iconNames() {
  QStringList names;
  for (const IconDrawing& one : iconDrawings()) {
    names << QString::fromUtf8(one.name.data(), qsizetype(one.name.size()));
  }
  return names;
}

}  // namespace chainmail
