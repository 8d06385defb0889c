#include "common/icons.h"

#include <QGuiApplication>
#include <QIconEngine>
#include <QPainter>
#include <QPainterPath>
#include <QPalette>
#include <algorithm>
#include <array>
#include <optional>
#include <sstream>
#include <string_view>

#include "common/colours.h"

namespace chainmail {
namespace {

/// An icon in a square of 16 units. It has paths to stroke and to fill, and paths to fill or stroke in the colour of a
/// mark in the views.
///
/// A path is a list of commands with absolute coordinates: M x y, L x y, C x1 y1 x2 y2 x y, Z as in SVG; E cx cy rx ry
/// is an ellipse, R x y w h a rectangle, A cx cy r start sweep an arc (degrees, counterclockwise from the right).
struct IconDrawing {
  std::string_view name, lines, fills = {};
  std::string_view marks = {}, markLines = {};
  colours::Colour mark = colours::marked;
  bool dashed = false;  // applies to the lines
};

constexpr std::string_view circle = "E 8 8 6.2 6.2";
constexpr std::string_view axes = "M 2 2 L 2 14 L 14 14";

constexpr std::array drawings{
    // Tools, with the marks that they make in the views.
    IconDrawing{"drag",
                "M 8 5 L 8 1 M 6.2 2.8 L 8 1 L 9.8 2.8 M 8 11 L 8 15 M 6.2 13.2 L 8 15 L 9.8 13.2 M 5 8 L 1 8 "
                "M 2.8 6.2 L 1 8 L 2.8 9.8 M 11 8 L 15 8 M 13.2 6.2 L 15 8 L 13.2 9.8",
                "E 8 8 1.6 1.6"},
    IconDrawing{"cut", "E 3.6 12.2 2.1 2.1 E 12.4 12.2 2.1 2.1 M 4.8 10.4 L 11.4 1.2 M 11.2 10.4 L 4.6 1.2"},
    IconDrawing{"pin", "M 8 9 L 8 15", {}, "M 8 0.8 L 13 5.8 L 8 10.8 L 3 5.8 Z", {}, colours::pinned},
    IconDrawing{"select", "R 1.2 1.2 13.6 13.6", {}, {}, "E 8 8 2.8 2.8", colours::selected, true},
    IconDrawing{"selectRectangle", "R 1.5 3.5 13 9", {}, {}, {}, colours::selected, true},
    IconDrawing{"selectBrush", "E 8 8 6 6", {}, "E 8 8 2 2", {}, colours::selected, true},
    IconDrawing{
        "measure",
        "M 1.6 11.4 L 11.4 1.6 L 14.4 4.6 L 4.6 14.4 Z M 4.2 8.8 L 5.8 10.4 M 6.6 6.4 L 7.6 7.4 M 9 4 L 10.6 5.6"},
    // Files.
    IconDrawing{"open", "M 1.7 13 L 1.7 3.5 L 6 3.5 L 7.5 5.2 L 13 5.2 L 13 7.2 M 1.7 13 L 4 7.2 L 15 7.2 L 12.8 13 Z"},
    IconDrawing{"save", "M 8 1.8 L 8 9.8 M 4.8 6.8 L 8 10 L 11.2 6.8 M 2 10.5 L 2 14 L 14 14 L 14 10.5"},
    IconDrawing{"file", "M 3 1.8 L 9.5 1.8 L 13 5.3 L 13 14.2 L 3 14.2 Z M 9.5 1.8 L 9.5 5.3 L 13 5.3"},
    IconDrawing{"shape",
                "M 1.5 4 C 5 1.5 11 6.5 14.5 3.5 M 1.5 12.5 C 5 10 11 15 14.5 12 M 1.5 4 C 3 7 0.5 10 1.5 12.5 "
                "M 14.5 3.5 C 13.5 6.5 15.5 9 14.5 12"},
    IconDrawing{"screenshot", "R 1.5 4.5 13 9 E 8 9 2.7 2.7 M 5.2 4.5 L 6.3 2.5 L 9.7 2.5 L 10.8 4.5"},
    IconDrawing{"picture", "R 1.8 2.8 12.4 10.4 M 1.8 11 L 6 7 L 9 10 L 11 8 L 14.2 11", "E 10.8 5.8 1.1 1.1"},
    IconDrawing{"movie", "R 1.5 3 13 10 M 1.5 6 L 14.5 6 M 5.5 3 L 4.5 6 M 9.5 3 L 8.5 6 M 13.5 3 L 12.5 6"},
    IconDrawing{"copy", "R 5 5 9 9 M 11 5 L 11 2 L 2 2 L 2 11 L 5 11"},
    IconDrawing{"quit", "M 9.5 2 L 3 2 L 3 14 L 9.5 14 M 6.5 8 L 14 8 M 11.2 5.2 L 14 8 L 11.2 10.8"},
    IconDrawing{"more", "M 3.5 3.5 L 8 8 L 3.5 12.5 M 8.5 3.5 L 13 8 L 8.5 12.5"},
    // Editing.
    IconDrawing{"undo", "M 3 6 L 10 6 C 14.2 6 14.2 12.8 10 12.8 L 6 12.8 M 5.8 3 L 2.8 6 L 5.8 9"},
    IconDrawing{"redo", "M 13 6 L 6 6 C 1.8 6 1.8 12.8 6 12.8 L 10 12.8 M 10.2 3 L 13.2 6 L 10.2 9"},
    IconDrawing{"history", "E 8 8 6.2 6.2 M 8 4.4 L 8 8 L 10.8 9.6"},
    IconDrawing{"giveUp", "E 8 8 6.2 6.2 M 3.8 3.8 L 12.2 12.2"},
    IconDrawing{"reset", "A 8 8.5 5.4 200 290 M 7.6 4 L 4.5 4.3 L 5.3 1.4"},
    IconDrawing{"resetObject", "A 8 8.5 5.4 200 290 M 7.6 4 L 4.5 4.3 L 5.3 1.4", "R 6.3 6.8 3.4 3.4"},
    IconDrawing{"resetStiffness",
                "A 8 8.5 5.4 200 290 M 7.6 4 L 4.5 4.3 L 5.3 1.4 M 5.4 8.6 L 6.7 7 L 8 10.2 L 9.3 7 L 10.6 8.6"},
    IconDrawing{"unpin", "M 8 9.5 L 8 15 M 8 0.8 L 13 5.8 L 8 10.8 L 3 5.8 Z M 1.5 13.5 L 14.5 1"},
    IconDrawing{"preset", "M 4 2 L 12 2 L 12 14 L 8 10.8 L 4 14 Z"}, IconDrawing{"plus", "M 8 3 L 8 13 M 3 8 L 13 8"},
    IconDrawing{"minus", "M 3 8 L 13 8"}, IconDrawing{"close", "M 4 4 L 12 12 M 12 4 L 4 12"},
    IconDrawing{"float", "R 3 6 7 7 M 6 6 L 6 3 L 13 3 L 13 10 L 10 10"},
    IconDrawing{"element", "M 6 2 L 5 14 M 11 2 L 10 14 M 2.5 5.5 L 14 5.5 M 2 10.5 L 13.5 10.5"},
    // Views.
    IconDrawing{"fit",
                "M 2 5.5 L 2 2 L 5.5 2 M 10.5 2 L 14 2 L 14 5.5 M 14 10.5 L 14 14 L 10.5 14 M 5.5 14 L 2 14 L 2 10.5",
                "E 8 8 2 2"},
    IconDrawing{"section", "M 2 4.6 L 8 1.6 L 14 4.6 L 14 11.4 L 8 14.4 L 2 11.4 Z M 8 1.6 L 8 14.4",
                "M 2 4.6 L 8 1.6 L 8 14.4 L 2 11.4 Z"},
    IconDrawing{"link", "E 5.5 8 4 2.9 E 10.5 8 4 2.9"},
    IconDrawing{"zoomIn", "E 6.8 6.8 4.8 4.8 M 10.4 10.4 L 14.2 14.2 M 4.8 6.8 L 8.8 6.8 M 6.8 4.8 L 6.8 8.8"},
    IconDrawing{"zoomOut", "E 6.8 6.8 4.8 4.8 M 10.4 10.4 L 14.2 14.2 M 4.8 6.8 L 8.8 6.8"},
    IconDrawing{"search", "E 6.8 6.8 4.8 4.8 M 10.4 10.4 L 14.2 14.2"},
    IconDrawing{"left", "M 13 8 L 3 8 M 7 4 L 3 8 L 7 12"}, IconDrawing{"right", "M 3 8 L 13 8 M 9 4 L 13 8 L 9 12"},
    IconDrawing{"up", "M 8 13 L 8 3 M 4 7 L 8 3 L 12 7"}, IconDrawing{"down", "M 8 3 L 8 13 M 4 9 L 8 13 L 12 9"},
    IconDrawing{"axes",
                "M 3.5 13 L 3.5 2 M 3.5 13 L 14 13 M 1.8 3.8 L 3.5 2 L 5.2 3.8 M 12.2 11.3 L 14 13 L 12.2 14.7"},
    IconDrawing{"colour",
                "M 8 1.6 C 10.5 5 12.6 7.4 12.6 10 C 12.6 12.7 10.6 14.4 8 14.4 C 5.4 14.4 3.4 12.7 3.4 10 "
                "C 3.4 7.4 5.5 5 8 1.6 Z",
                "M 8 1.6 C 10.5 5 12.6 7.4 12.6 10 C 12.6 12.7 10.6 14.4 8 14.4 Z"},
    IconDrawing{"theme", circle, "M 8 1.8 C 16.2 1.8 16.2 14.2 8 14.2 Z"},
    IconDrawing{
        "themeDark", {}, "M 10 1.8 C 1 1 -0.5 13.5 8.5 14.2 C 11.5 14.2 13.5 12.5 14.2 10.5 C 8.5 12 5.5 6 10 1.8 Z"},
    IconDrawing{"themeLight",
                "E 8 8 3.2 3.2 M 8 0.8 L 8 2.6 M 8 13.4 L 8 15.2 M 0.8 8 L 2.6 8 M 13.4 8 L 15.2 8 M 2.9 2.9 L 4.2 4.2 "
                "M 11.8 11.8 L 13.1 13.1 M 13.1 2.9 L 11.8 4.2 M 4.2 11.8 L 2.9 13.1"},
    IconDrawing{"region", "R 2.5 3.5 11 9", "E 8 8 1.7 1.7", {}, {}, colours::inside, true},
    IconDrawing{"eye", "M 1.2 8 C 4 3 12 3 14.8 8 C 12 13 4 13 1.2 8 Z E 8 8 2.2 2.2"},
    // Comparing.
    IconDrawing{"panels", "R 1.5 3 13 10 M 8 3 L 8 13"},
    IconDrawing{
        "swap",
        "M 2 5.5 L 13.5 5.5 M 10.8 2.8 L 13.5 5.5 L 10.8 8.2 M 14 10.5 L 2.5 10.5 M 5.2 7.8 L 2.5 10.5 L 5.2 13.2"},
    IconDrawing{
        "alone",
        "M 9.5 2.2 L 13.8 2.2 L 13.8 6.5 M 13.8 2.2 L 9.8 6.2 M 6.5 13.8 L 2.2 13.8 L 2.2 9.5 M 2.2 13.8 L 6.2 9.8"},
    IconDrawing{"overlay", "E 6 8 4.4 4.4 E 10 8 4.4 4.4"},
    IconDrawing{"difference", "M 8 2 L 8 9 M 4.5 5.5 L 11.5 5.5 M 4.5 12.8 L 11.5 12.8"},
    // Docks.
    IconDrawing{"tools", "R 2 2 4.6 4.6 R 9.4 2 4.6 4.6 R 2 9.4 4.6 4.6 R 9.4 9.4 4.6 4.6"},
    IconDrawing{"mesh", "M 2 13 L 8 2.5 L 14 13 Z M 5 7.7 L 11 7.7 L 8 13 Z"},
    IconDrawing{"stiffness", "M 1 8 L 3.2 8 L 5 3.5 L 7 12.5 L 9 3.5 L 11 12.5 L 12.8 8 L 15 8"},
    IconDrawing{"physics", "M 8 1 L 8 2.6 L 11.5 4 L 4.5 6 L 11.5 8 L 8 9.2", "R 4.5 9.6 7 4.9"},
    IconDrawing{"relaxation",
                "M 1.2 8 C 2.2 0 4.4 0 5.4 8 C 6.2 13.5 8 13.5 8.8 8 C 9.4 5 10.6 5 11.2 8 C 11.8 9.6 12.6 8 14.8 8"},
    IconDrawing{"frameRate", "A 8 10 6.2 200 -220 M 8 10 L 11 5.6", "E 8 10 1.4 1.4"},
    IconDrawing{"report", axes, "E 5.5 10.5 1.3 1.3 E 8.5 6.5 1.3 1.3 E 12 4.5 1.3 1.3"},
    IconDrawing{"propagation", "M 3 8 L 7.5 8 L 12.5 3.5 M 7.5 8 L 12.5 8 M 7.5 8 L 12.5 12.5",
                "E 3 8 1.7 1.7 E 12.7 3.3 1.5 1.5 E 12.7 8 1.5 1.5 E 12.7 12.7 1.5 1.5"},
    // Playing.
    IconDrawing{"play", {}, "M 4.5 2.5 L 13 8 L 4.5 13.5 Z"}, IconDrawing{"pause", {}, "R 4 3 2.8 10 R 9.2 3 2.8 10"},
    IconDrawing{"stop", {}, "R 3.5 3.5 9 9"}, IconDrawing{"record", circle, {}, "E 8 8 3.6 3.6", {}, colours::lit},
    IconDrawing{"stepForward", {}, "M 3.5 3 L 9.8 8 L 3.5 13 Z R 10.8 3 1.8 10"},
    IconDrawing{"stepBack", {}, "M 12.5 3 L 6.2 8 L 12.5 13 Z R 3.4 3 1.8 10"},
    IconDrawing{"toStart", {}, "M 14 3 L 8.6 8 L 14 13 Z M 8.6 3 L 3.2 8 L 8.6 13 Z R 1.4 3 1.6 10"},
    IconDrawing{"toEnd", {}, "M 2 3 L 7.4 8 L 2 13 Z M 7.4 3 L 12.8 8 L 7.4 13 Z R 13 3 1.6 10"},
    // Help and messages.
    IconDrawing{"keyboard", "R 1.2 4 13.6 8.5 M 5 10.2 L 11 10.2",
                "E 4 6.8 0.8 0.8 E 6.7 6.8 0.8 0.8 E 9.3 6.8 0.8 0.8 E 12 6.8 0.8 0.8"},
    IconDrawing{"lesson",
                "M 6 11.2 C 6 9.6 3.7 8.6 3.7 6 C 3.7 3.4 5.6 1.6 8 1.6 C 10.4 1.6 12.3 3.4 12.3 6 "
                "C 12.3 8.6 10 9.6 10 11.2 Z M 6.4 13 L 9.6 13 M 7 14.8 L 9 14.8"},
    IconDrawing{"help", "M 5.2 5.2 C 5.2 1.2 11 1.2 11 5 C 11 7.5 8 7.5 8 10", "E 8 13 1 1"},
    IconDrawing{"info", "E 8 8 6.4 6.4 M 8 7.4 L 8 11.4", "E 8 4.9 0.9 0.9"},
    IconDrawing{"warning", "M 8 2 L 14.6 13.6 L 1.4 13.6 Z M 8 6.4 L 8 9.4", "E 8 11.5 0.9 0.9"},
    IconDrawing{"error",
                "M 5.3 1.7 L 10.7 1.7 L 14.3 5.3 L 14.3 10.7 L 10.7 14.3 L 5.3 14.3 L 1.7 10.7 L 1.7 5.3 Z "
                "M 8 4.6 L 8 8.6",
                "E 8 11.1 0.9 0.9"}};

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
  const auto found = std::ranges::find(drawings, std::string_view(name), &IconDrawing::name);
  return found == drawings.end() ? QIcon() : QIcon(new DrawnIcon(*found, own));
}

}  // namespace

QIcon icon(const char* name) { return drawn(name, std::nullopt); }

QIcon icon(const char* name, const QColor& colour) { return drawn(name, colour); }

QStringList iconNames() {
  QStringList names;
  for (const IconDrawing& one : drawings) {
    names << QString::fromUtf8(one.name.data(), qsizetype(one.name.size()));
  }
  return names;
}

}  // namespace chainmail
