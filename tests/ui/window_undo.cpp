// Tests undo in a real window: every change of the object or its parameters is reverted, with bit-identical positions.

#include <QUndoView>

#include "document/edits.h"
#include "window.h"

namespace chainmail::window_undo {

namespace {

/// The state that undo must restore.
struct Picture {
  explicit Picture(Workbench& bench) : softness(*bench.document().wholeSoftness()) {
    Document& document = bench.document();
    for (int panel = 0; panel < 2; ++panel) {
      positions.push_back(document.solvers().frame(panel)->positions);
      algorithms.push_back(document.algorithm(panel));
      settings.push_back(bench.settings(panel));
    }
    cuts = document.cuts().links();
    pins = document.pins();
    relaxation = document.relaxation();
  }
  bool operator==(const Picture&) const = default;

  std::vector<std::vector<float>> positions;
  std::vector<Algorithm> algorithms;
  std::vector<SolverSettings> settings;
  std::vector<LinkId> cuts;
  std::vector<ElementId> pins;
  Softness softness;
  commands::SetRelaxation relaxation;
};

/// Makes a drag that ends at another position.
void drag(Workbench& bench, ElementId element, QPoint by, bool release = true) {
  const QPoint from = bench.place(0, element);
  bench.stroke(0, {from, from + by}, release);
}

}  // namespace

class WindowUndo : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

  void everyStepIsUndoneAndRedoneExactly() {
    Workbench bench;
    Document& document = bench.document();
    const std::vector<std::function<void()>> steps{
        [&] { drag(bench, 31, QPoint(120, -150)); },
        [&] {
          edits::cut(document, {3, 4, 40});
        },
        [&] { drag(bench, 0, QPoint(-60, 60)); },
        [&] {
          edits::setPinned(document, {8, 9}, true);
        },
        [&] {
          edits::setSoftness(document, {0.9, 1.05, 0}, QStringLiteral("stretch"));
        },
        [&] { bench.choose(0, "Exact ChainMail"); },
        [&] { drag(bench, 62, QPoint(90, 90)); },
        [&] {
          edits::setRelaxation(document, {true, 1, RelaxationScheme::mean});
        },
        [&] {
          edits::setRelaxation(document, {false, 0.5, RelaxationScheme::link});
        },
        [&] {
          edits::setElastic(document, {{2, 0.4}, {3, 4, 5}}, QStringLiteral("material"));
        },
        [&] {
          edits::setSoftnessOf(document, {2, 7}, LinkSoftness{0.5, 2, 1});
        },
        [&] { bench.trigger("resetObject"); },
        [&] {
          edits::replaceMesh(document, generate({MeshKind::tetra, {3, 3, 3}, 1, {}}), QStringLiteral("block"),
                             QStringLiteral("open block"));
        },
        [&] { drag(bench, 26, QPoint(40, -40)); }};
    std::vector<Picture> pictures{Picture(bench)};
    for (const auto& step : steps) {
      step();
      bench.settle();
      QCOMPARE(document.undoStack().count(), int(pictures.size()));
      pictures.emplace_back(bench);
    }
    for (const bool back : {true, false, true}) {
      for (std::size_t i = 0; i + 1 < pictures.size(); ++i) {
        bench.trigger(back ? "undo" : "redo");
        bench.settle();
        const std::size_t at = back ? pictures.size() - 2 - i : i + 1;
        QVERIFY2(Picture(bench) == pictures[at], qPrintable(QStringLiteral("step %1, back %2").arg(at).arg(back)));
      }
    }
  }

  void undoInTheMiddleOfADragTakesTheDragBack() {
    Workbench bench;
    drag(bench, 31, QPoint(120, -150));
    const Picture before(bench);
    drag(bench, 10, QPoint(-100, 60), false);
    bench.settle();
    const Picture held(bench);
    bench.trigger("undo");
    bench.settle();
    QVERIFY(Picture(bench) == before);
    QVERIFY(!bench.document().highlight().marks().grabbed);
    bench.trigger("redo");
    bench.settle();
    QVERIFY(Picture(bench) == held);
  }

  /// The button is still down then. Its release is none of the moves.
  void undoInTheMiddleOfADragRecordsOneRelease() {
    Workbench bench;
    const QPoint from = bench.place(0, 31);
    bench.stroke(0, {from, from + QPoint(120, -150)}, false);
    bench.trigger("undo");
    QTest::mouseRelease(&bench.view(0), Qt::LeftButton, {}, from + QPoint(120, -150));
    bench.settle();
    const auto moves = bench.document().moves().history().commands();
    QCOMPARE(
        std::ranges::count_if(moves, [](const Command& one) { return std::holds_alternative<commands::Release>(one); }),
        1);
    bench.trigger("redo");
    bench.settle();
    QCOMPARE(bench.document().moves().history().position(), moves.size());
  }

  void anEditDuringADragComesAfterTheDrag() {
    Workbench bench;
    const Picture rest(bench);
    drag(bench, 31, QPoint(100, -100), false);
    bench.settle();
    const Picture held(bench);
    bench.trigger("resetObject");
    bench.settle();
    QCOMPARE(bench.document().undoStack().count(), 2);
    bench.trigger("undo");
    bench.settle();
    QVERIFY(Picture(bench) == held);
    bench.trigger("undo");
    bench.settle();
    QVERIFY(Picture(bench) == rest);
  }

  void aPressWithoutAMoveIsNoStep() {
    Workbench bench;
    bench.click(0, 31);
    QCOMPARE(bench.document().undoStack().count(), 0);
    QVERIFY(!bench.find<QAction>("undo")->isEnabled());
  }

  void anAlgorithmThatDidNotFitComesBackWithItsMesh() {
    Workbench bench;
    bench.choose(0, "3D ChainMail");
    QCOMPARE(bench.document().algorithm(0), Algorithm::chainmail_3d);
    edits::replaceMesh(bench.document(), generate({MeshKind::tetra, {3, 3, 3}, 1, {}}), QStringLiteral("block"),
                       QStringLiteral("open block"));
    bench.settle();
    QCOMPARE(bench.document().algorithm(0), Algorithm::natural_queue);
    bench.trigger("undo");
    bench.settle();
    QCOMPARE(bench.document().algorithm(0), Algorithm::chainmail_3d);
    QCOMPARE(bench.document().solvers().frame(0)->statistics.algorithm, Algorithm::chainmail_3d);
  }

  void aClickInTheUndoListGoesThere() {
    Workbench bench;
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
