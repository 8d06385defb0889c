// Tests the description of the layout that settings and sessions share, on screens of any size.

#include "window/layout.h"

#include <QDirIterator>
#include <QFile>
#include <QJsonDocument>
#include <QRegularExpression>
#include <QTest>
#include <array>
#include <random>

#include "folders.h"
#include "program.h"
#include "window/docks.h"

namespace chainmail::layout {

namespace {

constexpr std::array screenSizes{QSize(1024, 600), QSize(1280, 720), QSize(1366, 768), QSize(1920, 1080),
                                 QSize(2560, 1440)};
enum class Way { floating, tabbed, hidden };

QStringList ids() {
  QStringList ids;
  for (const DockEntry& entry : dockEntries()) {
    ids << QLatin1String(entry.id);
  }
  return ids;
}

/// Returns a layout that uses a whole screen, with one of the docks in its last corner, in a tab or hidden.
Layout layoutOn(QSize screen, const QString& special, Way way) {
  Layout layout{.window = QRect({}, screen)};
  for (const DockEntry& entry : dockEntries()) {
    layout.docks.push_back({.id = QLatin1String(entry.id), .area = entry.area, .visible = true, .size = screen / 4});
    if (DockPlace& place = layout.docks.back(); place.id == special) {
      place.floating = way == Way::floating;
      place.visible = way != Way::hidden;
      place.size = place.floating ? screen - QSize(5, 5) : screen / 4;
      place.position = place.floating ? QPoint(screen.width() - 300, screen.height() - 200) : QPoint();
      place.tabs = way == Way::tabbed ? layout.docks.front().id : QString();
    }
  }
  return layout;
}

bool fits(const QRect& rect, const QList<QRect>& screens) {
  return std::ranges::any_of(screens, [&](const QRect& screen) { return screen.contains(rect); });
}

/// The window and all that floats is on a screen.
bool fits(const Layout& layout, const QList<QRect>& screens) {
  return (layout.window.isNull() || fits(layout.window, screens)) &&
         std::ranges::all_of(layout.docks, [&](const DockPlace& place) {
           return !place.floating || place.size.isEmpty() || fits({place.position, place.size}, screens);
         });
}

QByteArray textOf(const Layout& layout) { return QJsonDocument(toJson(layout)).toJson(QJsonDocument::Compact); }
Layout layoutIn(const QByteArray& text) { return layoutFrom(QJsonDocument::fromJson(text).object(), ids()); }

}  // namespace

class LayoutTest : public QObject {
  Q_OBJECT

 private slots:
  /// Each dock floats, is in a tab and is hidden, on five screens; each layout opens on all of them, at two scales.
  void everyLayoutFitsOnEveryScreen() {
    int count = 0;
    for (const QString& id : ids()) {
      for (const Way way : {Way::floating, Way::tabbed, Way::hidden}) {
        for (const QSize saved : screenSizes) {
          const Layout layout = layoutOn(saved, id, way);
          QCOMPARE(layoutIn(textOf(layout)), layout);
          for (const QSize now : screenSizes) {
            for (const int scale : {1, 2}) {
              const QList<QRect> screens{QRect({}, now / scale)};
              const Layout shown = fitted(layoutIn(textOf(layout)), screens);
              QVERIFY2(fits(shown, screens), textOf(shown).constData());
              QVERIFY(saved != now / scale || way == Way::floating || shown == layout);
              ++count;
            }
          }
        }
      }
    }
    QCOMPARE(count, int(ids().size()) * 3 * 5 * 5 * 2);
  }

  void aDockStaysOnTheScreenThatShowsIt() {
    const QList<QRect> screens{QRect(0, 0, 1920, 1080), QRect(1920, 0, 1280, 1024)};
    Layout layout{.docks = {{.id = QStringLiteral("meshDock"),
                             .floating = true,
                             .visible = true,
                             .size = {300, 400},
                             .position = {2900, 100}}}};
    layout = fitted(layout, screens);
    QCOMPARE(layout.docks.front().position, QPoint(2900, 100));
    layout = fitted(layout, {screens.front()});
    QCOMPARE(layout.docks.front().position, QPoint(1620, 100));
    QCOMPARE(fitted(layout, {}), layout);  // a computer may have no screen for a moment
  }

  /// The bytes of a disk, or somebody, altered them.
  void alteredLayoutsFit() {
    std::mt19937 random(20);
    const auto below = [&random](std::size_t end) { return std::size_t(random() % end); };
    const QList<QRect> screens{QRect(0, 0, 1366, 768), QRect(1366, 0, 1920, 1080)};
    int usable = 0;
    for (int i = 0; i < 10'000; ++i) {
      QByteArray text =
          textOf(layoutOn(screenSizes[below(5)], ids()[qsizetype(below(std::size_t(ids().size())))], Way(below(3))));
      const bool keepsJson = i % 2 == 0;
      for (std::size_t change = 1 + below(8); change > 0; --change) {
        const auto at = qsizetype(below(std::size_t(text.size())));
        const char before = text[at];
        if (keepsJson) {
          text[at] = QChar::isDigit(uint(before)) ? char('1' + below(9)) : QChar::isLetter(uint(before)) ? 'e' : before;
        } else if (below(2) == 0) {
          text.insert(at, "9e99");
        } else {
          text[at] = char(random());
        }
      }
      const Layout layout = fitted(layoutIn(text), screens);
      QVERIFY2(fits(layout, screens), text.constData());
      QStringList left = ids();
      for (const DockPlace& place : layout.docks) {
        QVERIFY2(left.removeOne(place.id), text.constData());
        QVERIFY2(QSize(10'000, 10'000).boundedTo(place.size) == place.size, text.constData());
      }
      usable += layout.docks.empty() ? 0 : 1;
    }
    QVERIFY(usable > 1000);
  }

  /// QMainWindow trusts the bytes that it saved: bytes from elsewhere end the program.
  void qtReadsNoStateOfWindows() {
    static const QRegularExpression state(QStringLiteral("(save|restore)(State|Geometry)\\("));
    QDirIterator files(sourceFile("ui"), {"*.cpp", "*.h"}, QDir::Files, QDirIterator::Subdirectories);
    int checked = 0;
    for (; files.hasNext(); ++checked) {
      QFile file(files.next());
      QVERIFY(file.open(QIODevice::ReadOnly));
      QVERIFY2(!state.match(QString::fromUtf8(file.readAll())).hasMatch(), qPrintable(file.fileName()));
    }
    QVERIFY(checked > 200);
  }
};

CHAINMAIL_TEST(LayoutTest)

}  // namespace chainmail::layout

#include "layout.moc"
