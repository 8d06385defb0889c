// Compares the views with reference pictures that a person has checked: tests/ui/pictures.

#include <QDir>
#include <QFileInfo>
#include <QHash>
#include <QImage>
#include <cmath>

#include "document/edits.h"
#include "folders.h"
#include "io/pictures.h"
#include "panels/panel_state.h"
#include "window.h"

namespace chainmail::window_views {

namespace {

// Renderers round differently, for example the position of a line. Pixels may differ by `maxApart` (of 255), and a
// share of `maxDifferent` may differ by more.
constexpr int maxApart = 48;
constexpr double maxDifferent = 0.002;

constexpr QSize viewSize(280, 210);  // logical pixels

/// Returns the share of the pixels that differ, and the picture with these pixels marked.
std::pair<double, QImage> compared(const QImage& now, const QImage& looked) {
  QImage marked = now;
  int different = 0;
  for (int y = 0; y < now.height(); ++y) {
    for (int x = 0; x < now.width(); ++x) {
      const QRgb a = now.pixel(x, y), b = looked.pixel(x, y);
      const int apart =
          std::max({std::abs(qRed(a) - qRed(b)), std::abs(qGreen(a) - qGreen(b)), std::abs(qBlue(a) - qBlue(b))});
      if (apart > maxApart) {
        marked.setPixel(x, y, qRgb(255, 0, 255));
        ++different;
      }
    }
  }
  return {double(different) / (double(now.width()) * now.height()), marked};
}

/// Returns an empty string if the picture is the same as the reference picture, else a description of the difference.
/// Saves a missing reference picture, which a person then checks.
QString differs(const QImage& picture, const QString& name) {
  const QImage now = picture.convertToFormat(QImage::Format_RGB32);
  const QString path = QDir(sourceFile("tests/ui/pictures")).filePath(name + QStringLiteral(".png"));
  if (!QFile::exists(path)) {
    QDir().mkpath(sourceFile("tests/ui/pictures"));
    now.save(path);
    return QStringLiteral("there was no %1: look at the one that was saved there now, and keep it if it is right")
        .arg(path);
  }
  const QImage looked = QImage(path).convertToFormat(QImage::Format_RGB32);
  if (looked.size() != now.size()) {
    return QStringLiteral("%1 has other pixels: %2 x %3").arg(path).arg(looked.width()).arg(looked.height());
  }
  const auto [share, marked] = compared(now, looked);
  if (share <= maxDifferent) {
    return {};
  }
  QDir().mkpath(builtFile("pictures"));
  const QString here = QDir(builtFile("pictures")).filePath(name);
  now.save(here + QStringLiteral(".png"));
  marked.save(here + QStringLiteral("-differs.png"));
  return QStringLiteral(
             "%1 % of the pixels differ from %2: see %3.png and %3-differs.png; if it is right now, it takes its place")
      .arg(100 * share, 0, 'f', 2)
      .arg(path, here);
}

/// Gives the views, which share a camera, a fixed size: independent of the window's size, and small, so that painting
/// them takes little time.
void fixViews(Workbench& bench) {
  for (int each = 0; each < bench.document().panels(); ++each) {
    bench.view(each).setFixedSize(viewSize);
  }
}

QString differs(Workbench& bench, int panel, const QString& name) {
  bench.trigger("fitView");
  bench.view(panel).zoom(0.6);  // space for the deformed object; only the rest shape fits
  bench.settleFigures();
  bench.document().highlight().set({});
  return differs(pictureOf(bench.view(panel)), name);
}

enum Object { plane, block, surface, volume, whole };

MeshPointer make(int object) {
  static const std::array recipes{
      MeshRecipe{MeshKind::grid, {9, 7, 1}, 1, {}}, MeshRecipe{MeshKind::tetra, {6, 4, 3}, 1, {}},
      MeshRecipe{MeshKind::cloth, {9, 7, 1}, 1, 3}, MeshRecipe{MeshKind::tetra, {9, 5, 4}, 1, {}},
      MeshRecipe{MeshKind::tetra, {9, 5, 4}, 1, {}}};
  return generate(recipes[std::size_t(object)]);
}

/// Returns the links of a cut from above, through half of the object, next to the dragged element.
std::vector<LinkId> cleft(const Mesh& mesh) {
  std::vector<LinkId> links;
  for (LinkId link = 0; link < mesh.link_count(); ++link) {
    const Point a = mesh.rest_position(mesh.links[link][0]), b = mesh.rest_position(mesh.links[link][1]);
    if ((a.x() < 3.5) != (b.x() < 3.5) && std::min(a.y(), b.y()) > 1.5) {
      links.push_back(link);
    }
  }
  return links;
}

}  // namespace

class WindowViews : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    failOnWarnings();
    QSettings().clear();
  }

  void theyAreAsTheyWereLookedAt_data() {
    QTest::addColumn<int>("object");
    QTest::addColumn<QStringList>("actions");
    QTest::addColumn<int>("panel");
    const auto add = [](const char* name, Object object, const QStringList& actions, int panel = 0) {
      QTest::newRow(name) << int(object) << actions << panel;
    };
    add("grid", plane, {});
    add("grid-light", plane, {QStringLiteral("themeLight")}, 1);
    add("block", block, {});
    add("block-light", block, {QStringLiteral("themeLight")}, 1);
    add("volume-cut", volume, {});
    add("volume-cut-light", volume, {QStringLiteral("themeLight"), QStringLiteral("showSurface")}, 1);
    add("section", whole, {QStringLiteral("section")});
    add("section-light", whole,
        {QStringLiteral("themeLight"), QStringLiteral("section"), QStringLiteral("showSurface")}, 1);
    add("surface", surface, {});
    add("surface-violation", surface, {QStringLiteral("colourBy-violation")});
    add("violation", plane, {QStringLiteral("colourBy-violation")});
    add("distance", block, {QStringLiteral("colourBy-distance")}, 1);
    add("ghost", plane, {QStringLiteral("ghosts")});
    add("regions", plane, {QStringLiteral("showValidRegions")});
    add("regions-in-space", block, {QStringLiteral("showValidRegions")});
    add("tree", plane, {QStringLiteral("showPropagation"), QStringLiteral("passLast")});
    add("spiral", plane, {QStringLiteral("showPropagation"), QStringLiteral("passLast")}, 1);
  }
  void theyAreAsTheyWereLookedAt() {
    QFETCH(int, object);
    QFETCH(QStringList, actions);
    QFETCH(int, panel);
    Workbench bench(make(object));
    fixViews(bench);
    edits::setPinned(bench.document(), {8}, true);
    edits::cut(bench.document(), object == volume ? cleft(*bench.document().mesh()) : std::vector<LinkId>{20});
    bench.settle();
    bench.document().selection().set({31});
    for (const QString& action : actions) {
      bench.trigger(action.toUtf8().constData());
    }
    bench.settle();
    const ElementId grabbed = object == volume || object == whole ? 40 : 31;
    const Point from = bench.document().mesh()->rest_position(grabbed);
    bench.document().handle().grab(grabbed);
    for (const double share : {0.5, 1.0}) {
      bench.document().handle().drag(from + share * Point(1.3, 1.6, object == plane ? 0 : 0.8));
      bench.settle();
    }
    bench.document().handle().release();
    bench.settle();
    const QString wrong = differs(bench, panel, QString::fromLatin1(QTest::currentDataTag()));
    bench.trigger("themeDark");
    QVERIFY2(wrong.isEmpty(), qPrintable(wrong));
  }

  void anObjectLooksTheSameWhereverItLiesAndOfAnySize_data() {
    QTest::addColumn<double>("size");
    QTest::addColumn<double>("x");
    QTest::addColumn<QStringList>("actions");
    for (const auto& [name, actions] :
         {std::pair("violation", QStringList{QStringLiteral("colourBy-violation")}),
          std::pair("length", QStringList{QStringLiteral("colourBy-length")}),
          std::pair("regions", QStringList{QStringLiteral("showValidRegions")}),
          std::pair("tree", QStringList{QStringLiteral("showPropagation"), QStringLiteral("passLast")}),
          std::pair("section", QStringList{QStringLiteral("section")})}) {
      QTest::addRow("a survey, %s", name) << 1.0 << 4.5e6 << actions;
      QTest::addRow("tiny, %s", name) << 5e-8 << 0.0 << actions;
      QTest::addRow("huge, %s", name) << 5e12 << 3e17 << actions;
    }
  }
  /// The twin is the same object about the origin.
  void anObjectLooksTheSameWhereverItLiesAndOfAnySize() {
    QFETCH(double, size);
    QFETCH(double, x);
    QFETCH(QStringList, actions);
    static QHash<QStringList, QImage> twins;
    if (!twins.contains(actions)) {
      twins[actions] = dragged(1, 0, actions);
    }
    const QImage here = twins[actions], there = dragged(size, x, actions);
    QCOMPARE(there.size(), here.size());
    const double share = compared(there, here).first;
    QVERIFY2(share <= maxDifferent, qPrintable(QString::number(share)));
  }

  void anObjectFarAwayHasNotMovedAtFirst() {
    Workbench bench(lying(1, 4.5e6));
    bench.settleFigures();
    const auto* line = bench.window.findChild<ViolationLine*>(QStringLiteral("violation0"));
    QTRY_COMPARE(line->sentence(), QStringLiteral("Nothing has moved yet"));
  }

 private:
  /// Returns an object of this size around a point that lies so far from the origin.
  static MeshPointer lying(double size, double x) {
    const Point middle(x, -x / 2, x / 3);
    const auto whole = generate({MeshKind::tetra, {6, 4, 3}, 1, {}});
    MeshParts parts;
    for (ElementId e = 0; e < whole->element_count(); ++e) {
      // Not a lattice, in which rounding decides between equal violations.
      const Point jitter = 0.2 * Point(std::sin(12.9 * e), std::sin(78.2 * e + 1), std::sin(37.7 * e + 2));
      parts.rest.push_back(size * (whole->rest_position(e) + jitter - Point(2.5, 1.5, 1)) + middle);
    }
    parts.links = whole->links;
    parts.tetrahedra = whole->tetrahedra;
    return build_mesh(std::move(parts));
  }
  static QImage dragged(double size, double x, const QStringList& actions) {
    Workbench bench(lying(size, x));
    fixViews(bench);
    bench.document().selection().set({31});
    for (const QString& action : actions) {
      bench.trigger(action.toUtf8().constData());
    }
    const ElementId grabbed = 31;
    const Point from = bench.document().mesh()->rest_position(grabbed);
    bench.document().handle().grab(grabbed);
    bench.document().handle().drag(from + size * Point(1.3, 1.6, 0.8));
    bench.document().handle().release();
    bench.settle();
    bench.trigger("fitView");
    bench.settleFigures();
    bench.document().highlight().set({});
    return pictureOf(bench.view(0)).convertToFormat(QImage::Format_RGB32);
  }
};

CHAINMAIL_WINDOW_TEST(WindowViews)

}  // namespace chainmail::window_views

#include "window_views.moc"
