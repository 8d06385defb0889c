// Tests undo in a real window: every change of the object or its parameters is reverted, with bit-identical positions.

#include <QDoubleSpinBox>
#include <QLabel>
#include <QUndoView>

#include "common/parameter_row.h"
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

  void undoGivesTheSolversTheirSettingsBack_data() {
    QTest::addColumn<SolverSettings>("after");
    const auto row = [](const char* name, const commands::SetRelaxation& relaxation, const ElasticOptions& elastic) {
      QTest::newRow(name) << SolverSettings{relaxation, elastic};
    };
    row("relaxation on", {true, 1, RelaxationScheme::mean}, {});
    row("relaxation's step", {false, 0.25, RelaxationScheme::mean}, {});
    row("relaxation's scheme", {false, 1, RelaxationScheme::link}, {});
    row("Young's modulus", {}, {{7, ElasticOptions().material.poisson}, ElasticOptions().lattice});
    row("Poisson's ratio", {}, {{ElasticOptions().material.young, 0.11}, ElasticOptions().lattice});
    row("the lattice", {}, {ElasticOptions().material, {2, 4, 3}});
  }

  /// The docks show the settings of the document. The solvers must use the same settings in the next drag.
  void undoGivesTheSolversTheirSettingsBack() {
    QFETCH(SolverSettings, after);
    Workbench bench;
    Document& document = bench.document();
    const SolverSettings before;
    QVERIFY(after != before);
    const auto everywhere = [&](const SolverSettings& settings) {
      for (int panel = 0; panel < document.panels(); ++panel) {
        QVERIFY(bench.settings(panel) == settings);
      }
      QVERIFY(document.relaxation() == settings.relaxation && document.elastic() == settings.elastic);
    };
    everywhere(before);
    edits::setRelaxation(document, after.relaxation);
    edits::setElastic(document, after.elastic, QStringLiteral("material"));
    for (int i = 0; i < 2; ++i) {
      everywhere(after);
      document.undo();
      everywhere(before);
      document.redo();
    }
  }

  void relaxationThatWasUndoneMovesNothingAnyMore() {
    Workbench bench, never;
    edits::setRelaxation(bench.document(), {true, 1, RelaxationScheme::mean});
    bench.document().undo();
    for (Workbench* one : {&bench, &never}) {
      one->document().handle().grab(31);
      one->document().handle().drag(Point(9, 9, 0));
      one->document().handle().release();
      one->settle();
    }
    for (int panel = 0; panel < 2; ++panel) {
      QVERIFY(!bench.document().solvers().frame(panel)->statistics.relaxing);
      QVERIFY(bench.document().solvers().frame(panel)->positions == never.document().solvers().frame(panel)->positions);
    }
  }

  void undoOfADragGivesEveryPositionBackAtAnyRate_data() {
    QTest::addColumn<int>("every");  // number of moves after which the test waits for the solvers
    for (const int every : {1, 3, 100}) {
      QTest::newRow(qPrintable(QStringLiteral("every %1").arg(every))) << every;
    }
  }

  void undoOfADragGivesEveryPositionBackAtAnyRate() {
    QFETCH(int, every);
    Workbench bench;
    Document& document = bench.document();
    drag(bench, 10, QPoint(-60, 60));
    const auto positions = [&] {
      return std::pair(document.solvers().snapshots()[0].get(), document.solvers().snapshots()[1].get());
    };
    const auto before = positions();
    for (const bool released : {true, false}) {  // undo also ends an unfinished drag
      document.handle().grab(31);
      for (int i = 1; i <= 12; ++i) {
        document.handle().drag(document.mesh()->rest_position(31) + Point(0.3 * i, 0.4 * i, 0));
        QTRY_VERIFY(i % every != 0 || document.solvers().idle());
      }
      if (released) {
        document.handle().release();
      }
      const auto after = positions();
      QVERIFY(after != before);
      document.undo();
      QVERIFY(positions() == before);
      document.redo();
      QVERIFY(positions() == after);
      document.undo();
    }
  }

  void aDragAfterAnUndoIsThatOfAFreshObject_data() {
    QTest::addColumn<Algorithm>("algorithm");
    for (const AlgorithmInfo& one : every_algorithm()) {
      QTest::newRow(std::string(one.name).c_str()) << one.algorithm;
    }
  }

  /// The undone drag must not affect the next one: no control points and no last result of an iteration remain.
  void aDragAfterAnUndoIsThatOfAFreshObject() {
    QFETCH(Algorithm, algorithm);
    const bool rectangular = algorithm == Algorithm::chainmail_3d;
    const MeshPointer mesh = generate({rectangular ? MeshKind::grid : MeshKind::cloth, {9, 7, 1}, 1, {}});
    Workbench bench(mesh), fresh(mesh);
    for (Workbench* one : {&bench, &fresh}) {
      edits::setAlgorithm(one->document(), 0, algorithm);
      edits::setPinned(one->document(), {0, 1, 2}, true);
      one->settle();
    }
    const auto pull = [](Workbench& one, ElementId element, const Point& by) {
      one.document().handle().grab(element);
      one.document().handle().drag(one.document().mesh()->rest_position(element) + by);
      one.document().handle().release();
      one.settle();
    };
    pull(bench, 40, Point(0.4, 0.7, 0));
    const std::vector<float> first = bench.document().solvers().frame(0)->positions;
    bench.document().undo();
    pull(bench, 60, Point(-0.2, 0.5, 0));
    pull(fresh, 60, Point(-0.2, 0.5, 0));
    QVERIFY(first != bench.document().solvers().frame(0)->positions);
    QVERIFY(bench.document().solvers().frame(0)->positions == fresh.document().solvers().frame(0)->positions);
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

  void aGestureOfASliderIsOneStep() {
    Workbench bench;
    drag(bench, 31, QPoint(120, -150));
    const Picture before(bench);
    Document& document = bench.document();
    for (const double stretch : {1.15, 1.1, 1.05, 1.0}) {
      edits::setSoftness(document, {0.8, stretch, 0.1}, QStringLiteral("stretch"), 7);
      bench.settle();  // so that each value is computed
    }
    for (const double step : {0.9, 0.7, 0.5}) {
      edits::setRelaxation(document, {false, step, RelaxationScheme::mean}, 8);
    }
    bench.settle();
    QCOMPARE(document.undoStack().count(), 3);
    const Picture after(bench);
    QVERIFY(after.positions != before.positions);  // the object follows while the user changes the value
    document.undo();
    document.undo();
    bench.settle();
    QVERIFY(Picture(bench) == before);
    document.redo();
    document.redo();
    bench.settle();
    QVERIFY(Picture(bench) == after);
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

  void whatIsMeasuredGoesWithItsMesh() {
    Workbench bench;
    bench.trigger("toolMeasure");
    bench.click(0, 60);
    bench.click(0, 62);
    bench.document().highlight().set({62, false, {}});
    edits::replaceMesh(bench.document(), generate({MeshKind::line, {3, 1, 1}, 1, {}}), QStringLiteral("line"),
                       QStringLiteral("build line"));
    QVERIFY(!bench.document().highlight().marks().element);
    QVERIFY(!bench.find<QLabel>("readout")->text().contains(QStringLiteral("62")));
    bench.trigger("undo");
    bench.settle();
  }

  /// Every undo step keeps its name in the list and the menu, for undo and redo. A click on a step restores the state
  /// after it.
  void theUndoListSaysWhatWasDone() {
    Workbench bench;
    Document& document = bench.document();
    const auto spin = [&](const char* name, double value) { bench.find<QDoubleSpinBox>(name)->setValue(value); };
    const std::vector<std::pair<QString, std::function<void()>>> steps{
        {QStringLiteral("drag of element 31"), [&] { drag(bench, 31, QPoint(100, -100)); }},
        {QStringLiteral("pin 2 elements"),
         [&] {
           edits::setPinned(document, {3, 4}, true);
         }},
        {QStringLiteral("unpin 1 element"), [&] { edits::setPinned(document, {3}, false); }},
        {QStringLiteral("cut 1 link"), [&] { edits::cut(document, {5}); }},
        {QStringLiteral("cut 3 links"),
         [&] {
           edits::cut(document, {7, 8, 40});
         }},
        {QStringLiteral("stretch"), [&] { spin("stretchSpin", 1.5); }},
        {QStringLiteral("softness of 2 links"),
         [&] {
           edits::setSoftnessOf(document, {2, 9}, LinkSoftness{0.5, 2, 1});
         }},
        {QStringLiteral("reset softness"), [&] { edits::resetSoftness(document); }},
        {QStringLiteral("relaxation settings"),
         [&] {
           edits::setRelaxation(document, {document.relaxation().on, 0.5, RelaxationScheme::link});
         }},
        {QStringLiteral("Spiral"), [&] { bench.choose(1, "Spiral"); }},
        {QStringLiteral("reset object"), [&] { bench.trigger("resetObject"); }},
        {QStringLiteral("replay"), [&] { document.moves().goTo(2); }},
        {QStringLiteral("build line"),
         [&] {
           edits::replaceMesh(document, generate({MeshKind::line, {9, 1, 1}, 1, {}}), QStringLiteral("line"),
                              QStringLiteral("build line"));
         }},
    };
    const auto words = [&](const char* action) { return bench.find<QAction>(action)->text().remove(QLatin1Char('&')); };
    std::vector<Picture> pictures{Picture(bench)};
    for (const auto& [name, step] : steps) {
      step();
      bench.settle();
      QCOMPARE(words("undo"), QStringLiteral("Undo ") + name);
      QCOMPARE(words("redo"), QStringLiteral("Redo"));
      pictures.emplace_back(bench);
    }
    auto* list = bench.find<QUndoView>("undoList");
    QCOMPARE(list->model()->rowCount(), int(steps.size()) + 1);
    for (std::size_t i = 0; i < steps.size(); ++i) {
      QCOMPARE(list->model()->index(int(i) + 1, 0).data().toString(), steps[i].first);
    }
    for (std::size_t i = steps.size(); i-- > 0;) {
      bench.trigger("undo");
      QCOMPARE(words("redo"), QStringLiteral("Redo ") + steps[i].first);
      QCOMPARE(words("undo"), i == 0 ? QStringLiteral("Undo") : QStringLiteral("Undo ") + steps[i - 1].first);
    }
    for (const int row : {4, int(steps.size()), 1, 7, 0}) {
      list->setCurrentIndex(list->model()->index(row, 0));
      bench.settle();
      QVERIFY2(Picture(bench) == pictures[std::size_t(row)], qPrintable(QString::number(row)));
    }
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
