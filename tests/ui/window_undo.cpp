// Tests undo in a real window: by mouse and keys, and by the list of steps. What is undone is tested in
// document_undo.cpp.

#include <QUndoView>

#include "document/edits.h"
#include "window.h"

namespace chainmail::window_undo {

namespace {

/// What undo must restore of drags and cuts.
struct Picture {
  explicit Picture(Workbench& bench) : cuts(bench.document().cuts().links()) {
    for (int panel = 0; panel < 2; ++panel) {
      positions.push_back(bench.document().solvers().frame(panel)->positions);
    }
  }
  bool operator==(const Picture&) const = default;

  std::vector<std::vector<float>> positions;
  std::vector<LinkId> cuts;
};

/// Makes a drag that ends at another position.
void drag(Workbench& bench, ElementId element, QPoint by) {
  const QPoint from = bench.place(0, element);
  bench.stroke(0, {from, from + by});
}

}  // namespace

class WindowUndo : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

  /// The button is still down then. Its release is not recorded as a move.
  void undoInTheMiddleOfADragRecordsOneRelease() {
    Workbench bench;
    drag(bench, 31, QPoint(120, -150));  // without a step, there would be nothing to undo
    const Picture before(bench);
    const QPoint from = bench.place(0, 10);
    bench.stroke(0, {from, from + QPoint(-100, 60)}, false);
    bench.settle();
    bench.trigger("undo");
    bench.settle();
    QVERIFY(!bench.document().highlight().marks().grabbed);
    QVERIFY(Picture(bench) == before);
    QTest::mouseRelease(&bench.view(0), Qt::LeftButton, {}, from + QPoint(-100, 60));
    bench.settle();
    const auto moves = bench.document().moves().history().commands();
    QCOMPARE(
        std::ranges::count_if(moves, [](const Command& one) { return std::holds_alternative<commands::Release>(one); }),
        2);  // one for each drag
    bench.trigger("redo");
    bench.settle();
    QCOMPARE(bench.document().moves().history().position(), moves.size());
  }

  void aPressIsNoStepAndAClickInTheUndoListGoesThere() {
    Workbench bench;
    bench.click(0, 31);
    QCOMPARE(bench.document().undoStack().count(), 0);
    QVERIFY(!bench.find<QAction>("undo")->isEnabled());
    const Picture rest(bench);
    drag(bench, 31, QPoint(100, -100));
    edits::cut(bench.document(), {5});
    auto* list = bench.find<QUndoView>("undoList");
    QCOMPARE(list->model()->rowCount(), 3);
    QCOMPARE(list->model()->index(1, 0).data().toString(), QStringLiteral("drag of element 31"));
    list->setCurrentIndex(list->model()->index(0, 0));
    bench.settle();
    QVERIFY(Picture(bench) == rest);
  }
};

CHAINMAIL_WINDOW_TEST(WindowUndo)

}  // namespace chainmail::window_undo

#include "window_undo.moc"
