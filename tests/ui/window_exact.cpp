// Tests exact work in a real window: figures of the element under the cursor, views along the axes, distances, and
// elements that are chosen by their ids.

#include <QDockWidget>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <QTableWidget>

#include "common/colours.h"
#include "document/edits.h"
#include "document/element_facts.h"
#include "window.h"

namespace chainmail::window_exact {

namespace {

constexpr ElementId middle = 31;  // of 9 x 7

MeshPointer block() { return generate({MeshKind::tetra, {4, 4, 4}, 1, {}}); }

QString readout(Workbench& bench) { return bench.find<QLabel>("readout")->text(); }

/// Sends the events of a double click, as a display sends them.
void doubleClick(View& view, QPoint place) {
  QTest::mouseClick(&view, Qt::LeftButton, {}, place);
  QTest::mouseDClick(&view, Qt::LeftButton, {}, place);
  QTest::mouseRelease(&view, Qt::LeftButton, {}, place);
}

void pick(Workbench& bench, int id) {
  bench.find<QDockWidget>("elementDock")->show();
  bench.find<QSpinBox>("elementId")->setValue(id);
  bench.settle();
}

}  // namespace

class WindowExact : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

  void hoverShowsTheElementsFigures() {
    Workbench bench;
    QVERIFY(readout(bench).contains(QStringLiteral("Left: drag an element")));
    edits::setSoftnessOf(bench.document(),
                         {bench.document().mesh()->entry_link[bench.document().mesh()->first_entry[middle]]},
                         LinkSoftness{0.5, 1.5, 0.1});
    bench.settle();
    QTest::mouseMove(&bench.view(1), bench.place(1, middle) + QPoint(2, 2));
    QTRY_COMPARE(bench.document().highlight().marks().element, std::optional<ElementId>(middle));
    const QString text = readout(bench);
    QVERIFY2(text.contains(QStringLiteral("Element 31")), qPrintable(text));
    QVERIFY2(text.contains(QStringLiteral("x 4, y 3")), qPrintable(text));  // no z, because the scene is in 2D
    QVERIFY2(!text.contains(QStringLiteral(", z ")), qPrintable(text));
    QVERIFY2(text.contains(QStringLiteral("compression 0.5–0.8, stretch 1.2–1.5, shear 0.1")), qPrintable(text));
    // The panel under the cursor comes first.
    QVERIFY2(text.indexOf(QStringLiteral("<b>B</b>")) < text.indexOf(QStringLiteral("A: ")), qPrintable(text));
    QTest::mouseMove(&bench.view(1), QPoint(2, 2));
    QTRY_VERIFY(readout(bench).contains(QStringLiteral("Left: drag an element")));
  }

  void looksAlongTheAxes_data() {
    QTest::addColumn<QString>("action");
    QTest::addColumn<int>("deep");    // the axis along the line of sight
    QTest::addColumn<int>("across");  // the axis that runs to the right, with its sign
    QTest::addColumn<int>("sign");
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("textWithZUp");
    const auto row = [](const char* view, int deep, int across, int sign, const char* text, const char* textWithZUp) {
      QTest::newRow(view) << view << deep << across << sign << QString::fromUtf8(text)
                          << QString::fromUtf8(textWithZUp);
    };
    row("viewFront", 2, 0, 1, "From +z (front)", "From +z (top)");
    row("viewBack", 2, 0, -1, "From −z (back)", "From −z (bottom)");
    row("viewRight", 0, 2, -1, "From +x (right)", "From +x (right)");
    row("viewLeft", 0, 2, 1, "From −x (left)", "From −x (left)");
    row("viewTop", 1, 0, 1, "From +y (top)", "From +y (back)");
    row("viewBottom", 1, 0, 1, "From −y (bottom)", "From −y (front)");
  }
  void looksAlongTheAxes() {
    QFETCH(QString, action);
    QFETCH(int, deep);
    QFETCH(int, across);
    QFETCH(int, sign);
    Workbench bench(block());
    const auto text = [&] { return bench.find<QAction>(qPrintable(action))->text().remove(QLatin1Char('&')); };
    QTEST(text(), "text");
    bench.trigger("upZ");
    QTEST(text(), "textWithZUp");
    bench.trigger("upZ");
    bench.trigger("parallelRays");
    bench.trigger(qPrintable(action));
    const std::array strides{1U, 4U, 16U};
    for (int p = 0; p < 2; ++p) {
      const QPointF at = bench.view(p).viewPosition(21);
      // With parallel rays, a farther element on the line of sight appears at the same position.
      QVERIFY((bench.view(p).viewPosition(21 + strides[std::size_t(deep)]) - at).manhattanLength() < 0.1);
      const QPointF beside = bench.view(p).viewPosition(21 + strides[std::size_t(across)]) - at;
      QVERIFY(beside.x() * sign > 20);
      QVERIFY(std::abs(beside.y()) < 0.1);
    }
  }

  void aDoubleClickRecentresAndLeavesNoDragBehind() {
    for (const auto& mesh : {generate({MeshKind::grid, {9, 7, 1}, 1, {}}), block()}) {
      Workbench bench(mesh);
      const ElementId element = mesh->space_dimension == 3 ? 53 : 5;  // 53 is visible on the front of the block
      QCOMPARE(bench.view(0).search().elementAt(bench.place(0, element)), std::optional(element));
      doubleClick(bench.view(0), bench.place(0, element));
      const auto isInTheMiddle = [&] {
        for (int p = 0; p < 2; ++p) {
          // The cameras are linked.
          const QPointF off = bench.view(p).viewPosition(element) - QRectF(bench.view(p).rect()).center();
          QVERIFY2(off.manhattanLength() < 2, qPrintable(QStringLiteral("%1 %2").arg(off.x()).arg(off.y())));
        }
      };
      isInTheMiddle();
      const QSize before = bench.view(0).size();
      bench.window.resize(bench.window.size() - QSize(150, 100));
      bench.settle();
      QVERIFY(bench.view(0).size() != before);
      isInTheMiddle();
      QVERIFY(bench.document().handle().held().empty());
      const QPointF middleOfView = QRectF(bench.view(0).rect()).center();
      QMouseEvent move(QEvent::MouseMove, middleOfView + QPointF(50, 50),
                       bench.view(0).mapToGlobal(middleOfView + QPointF(50, 50)), Qt::NoButton, Qt::NoButton,
                       Qt::NoModifier);
      QApplication::sendEvent(&bench.view(0), &move);
      bench.settle();
      QCOMPARE(bench.document().solvers().frame(0)->statistics.passes, 0U);
    }
  }

  void aDistanceIsMeasuredAndStaysWithTheElements() {
    Workbench bench;
    QTest::keyClick(&bench.window, Qt::Key_M);
    bench.click(0, 27);
    QVERIFY(readout(bench).contains(QStringLiteral("From element 27: click another one")));
    bench.click(0, 31);
    QVERIFY2(readout(bench).contains(QStringLiteral("From element 27 to 31, at rest 4")), qPrintable(readout(bench)));
    const QPointF along = (bench.view(1).viewPosition(28) + bench.view(1).viewPosition(29)) / 2;
    QVERIFY(bench.distanceFromColour(1, along, colours::marked) < 20);  // a line, also in the other panel

    bench.trigger("toolDrag");
    bench.stroke(0, {bench.place(0, 31), bench.place(0, 31) + QPoint(0, -160)});
    bench.document().highlight().set({});
    bench.trigger("addPanel");
    bench.settle();
    const QPointF middleOfLine = (bench.view(2).viewPosition(27) + bench.view(2).viewPosition(31)) / 2;
    QVERIFY(bench.distanceFromColour(2, middleOfLine, colours::marked) < 20);

    QTest::keyClick(&bench.window, Qt::Key_Escape);
    QVERIFY(readout(bench).contains(QStringLiteral("Left: drag an element")));
  }

  void anElementIsPickedByItsId() {
    Workbench bench;
    QTest::keyClick(&bench.window, Qt::Key_E, Qt::ControlModifier);
    QVERIFY(bench.find<QDockWidget>("elementDock")->isVisible());
    auto* id = bench.find<QSpinBox>("elementId");
    QTRY_VERIFY(id->hasFocus());
    QVERIFY(id->suffix().contains(QStringLiteral("0 to 62")));
    QVERIFY(!bench.find<QPushButton>("moveElement")->isEnabled());
    id->selectAll();
    QTest::keyClicks(id, QStringLiteral("31"));
    QTest::keyClick(id, Qt::Key_Return);
    QCOMPARE(bench.document().selection().elements(), std::vector<ElementId>{31});
    auto* positions = bench.find<QTableWidget>("elementPositions");
    QCOMPARE(positions->rowCount(), 3);  // at rest, left, right
    QCOMPARE(positions->columnCount(), 3);
    QCOMPARE(bench.find<QTableWidget>("elementNeighbours")->rowCount(), 4);
    // A selection from elsewhere is also shown if it is one element.
    bench.document().selection().set({0});
    QCOMPARE(id->value(), 0);
    QCOMPARE(bench.find<QTableWidget>("elementNeighbours")->rowCount(), 2);
    bench.document().selection().set({});
    QVERIFY(!bench.find<QPushButton>("moveElement")->isEnabled());
  }

  void pinsAndCutsByTheDock() {
    Workbench bench;
    pick(bench, middle);
    auto* cut = bench.find<QPushButton>("cutLink");
    QVERIFY(!cut->isEnabled());
    QVERIFY(cut->toolTip().contains(QStringLiteral("Select a neighbour")));
    auto* neighbours = bench.find<QTableWidget>("elementNeighbours");
    neighbours->selectRow(1);
    const ElementId to = bench.document().mesh()->neighbours_of(middle)[1];
    QCOMPARE(neighbours->item(1, 0)->text(), QString::number(to));
    cut->click();
    QVERIFY(bench.document().cuts().is_cut(*find_link(*bench.document().mesh(), middle, to)));
    QTRY_COMPARE(neighbours->item(1, 4)->text(), QStringLiteral("cut"));
    QVERIFY(!cut->isEnabled());
    bench.document().undoStack().undo();
    QTRY_VERIFY(cut->isEnabled());

    bench.find<QPushButton>("pinElement")->click();
    QVERIFY(isPinned(bench.document(), middle));
    QTRY_VERIFY(!bench.find<QPushButton>("moveElement")->isEnabled());
    QVERIFY(bench.find<QPushButton>("moveElement")->toolTip().contains(QStringLiteral("pinned")));
    bench.find<QPushButton>("pinElement")->click();
    QVERIFY(!isPinned(bench.document(), middle));
  }
};

CHAINMAIL_WINDOW_TEST(WindowExact)

}  // namespace chainmail::window_exact

#include "window_exact.moc"
