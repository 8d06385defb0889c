// Tests the menu of an element in a real window, and what the window says about objects of one element or one link.

#include <QClipboard>
#include <QContextMenuEvent>
#include <QLabel>
#include <QMenu>

#include "common/colours.h"
#include "document/edits.h"
#include "document/element_facts.h"
#include "panels/violation_line.h"
#include "tools/element_menu.h"
#include "window.h"

namespace chainmail::window_element_menu {

namespace {

constexpr ElementId middle = 31;  // of the grid of 9 x 7

QMenu& menuOf(Workbench& bench) { return *bench.find<QMenu>("elementMenu"); }

void rightClick(Workbench& bench, ElementId element) {
  QTest::mouseClick(&bench.view(0), Qt::RightButton, {}, bench.place(0, element));
}

void choose(Workbench& bench, const char* action) {
  QVERIFY(menuOf(bench).isVisible());
  menuOf(bench).close();
  bench.trigger(action);
  bench.settle();
}

}  // namespace

class WindowElementMenu : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    failOnWarnings();
    QSettings().clear();
  }

  void aRightClickOpensItAndItsActionsWork() {
    Workbench bench;
    rightClick(bench, middle);
    QCOMPARE(menuOf(bench).actions().front()->text(), QStringLiteral("Element 31"));
    QCOMPARE(bench.find<QAction>("elementMenuPin")->text(), QStringLiteral("&Pin"));
    choose(bench, "elementMenuPin");
    QVERIFY(isPinned(bench.document(), middle));
    rightClick(bench, middle);
    QCOMPARE(bench.find<QAction>("elementMenuPin")->text(), QStringLiteral("Un&pin"));
    choose(bench, "elementMenuPin");
    QVERIFY(!isPinned(bench.document(), middle));
    rightClick(bench, middle);
    choose(bench, "elementMenuCopy");
    QCOMPARE(QApplication::clipboard()->text(), QStringLiteral("31"));
    rightClick(bench, 0);
    choose(bench, "elementMenuCentre");
    const QPoint offset = bench.place(0, 0) - bench.view(0).rect().center();
    QVERIFY2(offset.manhattanLength() < 4, qPrintable(QString::number(offset.manhattanLength())));
  }

  /// A background job may replace the object while the menu is open.
  void anotherObjectClosesItAndItsActionsDoNothing() {
    Workbench bench;
    rightClick(bench, 62);
    QVERIFY(menuOf(bench).isVisible());
    edits::replaceMesh(bench.document(), generate({MeshKind::grid, {3, 3, 1}, 1, {}}), QStringLiteral("small"),
                       QStringLiteral("open"));
    QTRY_VERIFY(!menuOf(bench).isVisible());
    bench.settle();
    bench.trigger("elementMenuPart");
    bench.trigger("elementMenuPin");
    QVERIFY(bench.document().selection().elements().empty() && bench.document().pins().empty());
  }

  void itsPartEndsAtCuts() {
    Workbench bench;
    const Mesh& mesh = *bench.document().mesh();
    std::vector<LinkId> between;  // the columns 3 and 4
    for (LinkId link = 0; link < mesh.link_count(); ++link) {
      if (mesh.links[link][0] % 9 == 3 && mesh.links[link][1] % 9 == 4) {
        between.push_back(link);
      }
    }
    QCOMPARE(between.size(), std::size_t{7});
    edits::cut(bench.document(), between);
    bench.settle();
    rightClick(bench, middle);  // in column 4
    choose(bench, "elementMenuPart");
    QCOMPARE(bench.document().selection().elements().size(), std::size_t{35});
    for (const ElementId element : bench.document().selection().elements()) {
      QVERIFY(element % 9 >= 4);
    }
  }

  void aDragOfTheRightButtonTurnsTheObjectInstead() {
    Workbench bench(generate({MeshKind::tetra, {5, 5, 5}, 1, {}}));
    const double yaw = bench.view(0).camera()->pose().yaw;
    const QPoint from = bench.place(0, 62);
    QTest::mousePress(&bench.view(0), Qt::RightButton, {}, from);
    for (const QPoint& to : {from + QPoint(40, 0), from}) {  // and back to where it began
      QMouseEvent move(QEvent::MouseMove, to, bench.view(0).mapToGlobal(to), Qt::NoButton, Qt::RightButton, {});
      QApplication::sendEvent(&bench.view(0), &move);
      if (to != from) {
        QVERIFY(bench.view(0).camera()->pose().yaw != yaw);
      }
    }
    QTest::mouseRelease(&bench.view(0), Qt::RightButton, {}, from);
    QVERIFY(!menuOf(bench).isVisible());
    rightClick(bench, 62);
    QVERIFY(menuOf(bench).isVisible());
  }

  void theMenuKeyOpensItForTheHighlightedElement() {
    Workbench bench;
    const auto pressMenuKey = [&bench] {
      QContextMenuEvent wanted(QContextMenuEvent::Keyboard, {5, 5}, bench.view(0).mapToGlobal(QPoint(5, 5)));
      QApplication::sendEvent(&bench.view(0), &wanted);
    };
    pressMenuKey();
    QVERIFY(!menuOf(bench).isVisible());
    bench.document().highlight().set({middle, false, {}});
    pressMenuKey();
    QVERIFY(menuOf(bench).isVisible());
    QCOMPARE(menuOf(bench).actions().front()->text(), QStringLiteral("Element 31"));
    menuOf(bench).close();
    bench.document().highlight().set({});
    bench.document().selection().set({7});
    pressMenuKey();
    QCOMPARE(menuOf(bench).actions().front()->text(), QStringLiteral("Element 7"));
    menuOf(bench).close();
  }

  void onlyTheGroundHasNoMenu() {
    Workbench bench;
    QTest::mouseClick(&bench.view(0), Qt::RightButton, {}, QPoint(5, bench.view(0).height() - 5));
    QVERIFY(!menuOf(bench).isVisible());
  }

  void oneElementIsADotAndIsCountedAsOne() {
    MeshParts parts;
    parts.rest = {Point(0, 0, 0)};
    Workbench bench(build_mesh(parts));
    const QString about = bench.find<QLabel>("meshDescription")->text();
    QVERIFY2(about.contains(QStringLiteral("1 element, 0 links")), qPrintable(about));
    bench.settle();
    const QPoint at = bench.place(0, 0);
    QVERIFY(bench.view(0).rect().contains(at));
    const QColor dot = bench.view(0).grabFramebuffer().pixelColor(at), ground = colours::background;
    QVERIFY2(std::abs(dot.red() - ground.red()) + std::abs(dot.green() - ground.green()) > 80, qPrintable(dot.name()));
  }

  void oneLinkIsCountedAsOne() {
    Workbench bench(generate({MeshKind::line, {2, 1, 1}, 1, {}}));
    const QString about = bench.find<QLabel>("meshDescription")->text();
    QVERIFY2(about.contains(QStringLiteral("2 elements, 1 link")) && !about.contains(QStringLiteral("1 links")),
             qPrintable(about));
    const QPoint from = bench.place(0, 1);
    bench.stroke(0, {from, from + QPoint(100, 0)});
    bench.settleFigures();
    const QString figures = bench.window.panel(0).findChild<ViolationLine*>()->toolTip();
    QVERIFY2(figures.contains(QStringLiteral("1 link checked")), qPrintable(figures));
  }
};

CHAINMAIL_WINDOW_TEST(WindowElementMenu)

}  // namespace chainmail::window_element_menu

#include "window_element_menu.moc"
