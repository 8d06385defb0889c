// Tests that the window fits on its screen. CMakeLists.txt runs them on small screens and large ones, with a window
// manager that draws frames.

#include <QDockWidget>
#include <QJsonDocument>
#include <QScopeGuard>
#include <QStatusBar>
#include <QToolBar>

#include "window.h"
#include "window/docks.h"

namespace chainmail::window_screen {

namespace {

/// The window with its frame is on the screen.
bool fits(const MainWindow& window) {
  const int rounding = window.devicePixelRatioF() > 1 ? 1 : 0;  // of a frame with an odd number of pixels
  return window.screen()->availableGeometry().adjusted(0, 0, rounding, rounding).contains(window.frameGeometry());
}

QString placeOf(const MainWindow& window) {
  const QRect at = window.frameGeometry();
  return QStringLiteral("%1 x %2 at %3, %4").arg(at.width()).arg(at.height()).arg(at.x()).arg(at.y());
}

/// Returns where each dock is and whether it is seen, without sizes.
std::vector<DockPlace> docksOf(const MainWindow& window) {
  Layout layout = window.arrangement();
  for (DockPlace& place : layout.docks) {
    place.size = {};
    place.position = {};
  }
  return layout.docks;
}

}  // namespace

class WindowScreen : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    failOnWarnings();
    QSettings().clear();
  }

  void theFirstWindowFitsWithItsFrame() {
    Workbench bench;
    QTRY_VERIFY2(fits(bench.window), qPrintable(placeOf(bench.window)));
    const auto* status = bench.window.statusBar();
    const QRect line(status->mapToGlobal(QPoint()), status->size());
    QVERIFY(status->isVisible() && bench.window.screen()->availableGeometry().contains(line));
  }

  void everyDockFitsBesideTheOthers_data() {
    QTest::addColumn<int>("dpi");
    QTest::newRow("96 dpi") << 96;
    QTest::newRow("150 dpi") << 150;
  }
  void everyDockFitsBesideTheOthers() {
    QFETCH(int, dpi);
    const QFont usual = QApplication::font();
    const auto restore = qScopeGuard([&usual] { QApplication::setFont(usual); });
    QFont font = usual;
    font.setPointSizeF(usual.pointSizeF() * dpi / 96);
    QApplication::setFont(font);
    Workbench bench;
    QTRY_VERIFY2(fits(bench.window), qPrintable(placeOf(bench.window)));
    const QRect before = bench.window.geometry();
    const bool wasMaximized = bench.window.isMaximized();
    QList<QDockWidget*> opened;
    for (const DockEntry& entry : dockEntries()) {
      if (auto* dock = bench.find<QDockWidget>(entry.id); dock->isHidden()) {
        bench.trigger(entry.action);
        bench.settle();
        opened << dock;
        QVERIFY2(bench.window.geometry() == before, qPrintable(entry.id + placeOf(bench.window)));
      }
    }
    for (QDockWidget* dock : opened) {
      dock->hide();
    }
    bench.settle();
    QVERIFY2(bench.window.geometry() == before, qPrintable(placeOf(bench.window)));
    QCOMPARE(bench.window.isMaximized(), wasMaximized);
  }

  void theOptionsOfAToolMoveNothing() {
    Workbench bench;
    const auto* mesh = bench.find<QDockWidget>("meshDock");
    const QRect before = mesh->geometry();
    for (const char* tool : {"toolCut", "toolSelect", "toolDrag"}) {
      bench.trigger(tool);
      bench.settle();
      QCOMPARE(mesh->geometry(), before);
    }
  }

  /// Each dock floats, is in a tab and is hidden, in a layout of a larger screen.
  void layoutsOfALargerScreenFit() {
    const auto take = [](const QString& id, bool floats, bool isTab) {
      Layout layout{.window = {112, 112, 3800, 2000}};
      for (const DockEntry& entry : dockEntries()) {
        const QString one = QLatin1String(entry.id);
        layout.docks.push_back({.id = one,
                                .area = entry.area,
                                .floating = floats && one == id,
                                .visible = one != id || floats || isTab,
                                .tabs = isTab && one == id ? QLatin1String(dockEntries().front().id) : one,
                                .front = true,
                                .size = {900, 700},
                                .position = {3000, 1500}});
      }
      return layout;
    };
    QSettings().setValue(
        QStringLiteral("window"),
        QString::fromUtf8(QJsonDocument(toJson(take(QStringLiteral("stiffnessDock"), true, false))).toJson()));
    Workbench bench;
    QTRY_VERIFY2(fits(bench.window), qPrintable(placeOf(bench.window)));
    for (const DockEntry& entry : dockEntries()) {
      const QString id = QLatin1String(entry.id);
      for (const Layout& layout : {take(id, true, false), take(id, false, true), take(id, false, false)}) {
        bench.window.takeDocks(toJson(layout));
        for (const auto* dock : bench.window.findChildren<QDockWidget*>()) {
          QVERIFY2(!dock->isFloating() || bench.window.screen()->geometry().contains(dock->geometry()), entry.id);
        }
      }
      bench.settle();
      QVERIFY2(fits(bench.window), qPrintable(entry.id + placeOf(bench.window)));
    }
  }

  void resetLayoutShowsTheDocksAsAtTheFirstStart() {
    Workbench bench;
    const auto before = docksOf(bench.window);
    bench.trigger("showPropagation");
    bench.find<QDockWidget>("toolsDock")->setFloating(true);
    bench.find<QDockWidget>("meshDock")->hide();
    bench.window.addDockWidget(Qt::BottomDockWidgetArea, bench.find<QDockWidget>("stiffnessDock"));
    bench.settle();
    QVERIFY(docksOf(bench.window) != before);
    bench.trigger("resetLayout");
    QTRY_VERIFY(docksOf(bench.window) == before);
    QVERIFY(bench.find<QToolBar>("mainToolBar")->isVisible());
  }
};

CHAINMAIL_WINDOW_TEST(WindowScreen)

}  // namespace chainmail::window_screen

#include "window_screen.moc"
