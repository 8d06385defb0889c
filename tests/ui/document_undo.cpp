// Undo of a document: every change of the object or its parameters is reverted, with bit-identical positions.

#include <QTest>
#include <algorithm>
#include <functional>
#include <future>

#include "document/edits.h"
#include "document_bench.h"
#include "mesh/generate.h"
#include "program.h"

namespace chainmail::test_document_undo {

namespace {

/// Settings of a solver that are not part of the object.
struct Settings {
  commands::SetRelaxation relaxation;
  ElasticOptions elastic;

  bool operator==(const Settings&) const = default;
};

Settings settings_of(Document& document, int panel) {
  std::promise<Settings> settings;
  document.solvers().ask(panel, [&settings](const Simulation& now) {
    settings.set_value({now.relaxation(), now.elastic()});
  });
  return settings.get_future().get();
}

/// The state that undo must restore.
struct State {
  explicit State(Document& document) : positions(shapes_of(document)), softness(*document.wholeSoftness()) {
    for (int panel = 0; panel < document.panels(); ++panel) {
      algorithms.push_back(document.algorithm(panel));
      settings.push_back(settings_of(document, panel));
    }
    cuts = document.cuts().links();
    pins = document.pins();
    relaxation = document.relaxation();
  }
  bool operator==(const State&) const = default;

  std::vector<std::vector<float>> positions;
  std::vector<Algorithm> algorithms;
  std::vector<Settings> settings;
  std::vector<LinkId> cuts;
  std::vector<ElementId> pins;
  Softness softness;
  commands::SetRelaxation relaxation;
};

}  // namespace

class DocumentUndoTest : public QObject {
  Q_OBJECT

 private slots:
  void every_step_is_undone_and_redone_exactly();
  void undo_in_the_middle_of_a_drag_takes_the_drag_back();
  void an_edit_during_a_drag_comes_after_the_drag();
  void a_reset_is_exact_and_is_undone();
  void undo_of_a_mesh_brings_the_deformed_object_back();
  void an_algorithm_that_did_not_fit_comes_back_with_its_mesh();
  void steps_of_a_removed_panel_are_undone();

 private:
  const MeshPointer grid_ = generate({MeshKind::grid, {9, 7, 1}, 1, {}});
  const MeshPointer block_ = generate({MeshKind::tetra, {3, 3, 3}, 1, {}});
};

void DocumentUndoTest::every_step_is_undone_and_redone_exactly() {
  Document document(grid_, QStringLiteral("sheet"));
  QVERIFY(has_settled(document));
  const auto drag = [&](ElementId element, const Point& by) { QVERIFY(drag_and_release(document, element, by)); };
  const std::vector<std::function<void()>> steps{
      [&] {
        drag(31, {1.8, 2.2, 0});
      },
      [&] {
        edits::cut(document, {3, 4, 40});
      },
      [&] {
        drag(0, {-0.9, -0.9, 0});
      },
      [&] {
        edits::setPinned(document, {8, 9}, true);
      },
      [&] { edits::setPinned(document, {9}, false); },
      [&] {
        edits::setSoftness(document, {0.9, 1.05, 0}, QStringLiteral("stretch"));
      },
      [&] { edits::setAlgorithm(document, 0, Algorithm::exact); },
      [&] {
        drag(62, {1.3, -1.3, 0});
      },
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
      [&] { edits::resetObject(document); },
      [&] { edits::replaceMesh(document, block_, QStringLiteral("block"), QStringLiteral("open block")); },
      [&] {
        drag(26, {0.6, 0.6, 0});
      }};
  std::vector<State> states{State(document)};
  for (const auto& step : steps) {
    step();
    QVERIFY(has_settled(document));
    QCOMPARE(document.undoStack().count(), int(states.size()));
    states.emplace_back(document);
    QVERIFY(!(states.back() == states[states.size() - 2]));
  }
  for (const bool back : {true, false, true}) {
    for (std::size_t i = 0; i + 1 < states.size(); ++i) {
      back ? document.undo() : document.redo();
      QVERIFY(has_settled(document));
      const std::size_t at = back ? states.size() - 2 - i : i + 1;
      QVERIFY2(State(document) == states[at], qPrintable(QStringLiteral("step %1, back %2").arg(at).arg(back)));
    }
  }
}

void DocumentUndoTest::undo_in_the_middle_of_a_drag_takes_the_drag_back() {
  Document document(grid_, QStringLiteral("sheet"));
  QVERIFY(has_settled(document));
  QVERIFY(drag_and_release(document, 31, {1.8, 2.2, 0}));
  const State before(document);
  QVERIFY(drag_and_hold(document, 10, {-1.5, -0.9, 0}));
  const State held(document);
  QVERIFY(!(held == before));
  document.undo();
  QVERIFY(has_settled(document));
  QVERIFY(State(document) == before);
  QVERIFY(!document.handle().isActive());
  document.redo();
  QVERIFY(has_settled(document));
  QVERIFY(State(document) == held);
}

void DocumentUndoTest::an_edit_during_a_drag_comes_after_the_drag() {
  Document document(grid_, QStringLiteral("sheet"));
  QVERIFY(has_settled(document));
  const State rest(document);
  QVERIFY(drag_and_hold(document, 31, {1.5, 1.5, 0}));
  const State held(document);
  edits::resetObject(document);
  QVERIFY(has_settled(document));
  QCOMPARE(document.undoStack().count(), 2);
  document.undo();
  QVERIFY(has_settled(document));
  QVERIFY(State(document) == held);
  document.undo();
  QVERIFY(has_settled(document));
  QVERIFY(State(document) == rest);
}

void DocumentUndoTest::a_reset_is_exact_and_is_undone() {
  Document document(grid_, QStringLiteral("sheet"));
  QVERIFY(has_settled(document));
  QVERIFY(drag_and_release(document, 31, {0, 3, 0}));
  const auto deformed = shapes_of(document);
  QVERIFY(position_of(document, 1, 40) != grid_->rest_position(40));
  edits::resetObject(document);
  QVERIFY(has_settled(document));
  for (const auto& shape : shapes_of(document)) {
    QVERIFY(std::ranges::equal(shape, grid_->rest));
  }
  document.undo();
  QVERIFY(has_settled(document));
  QVERIFY(shapes_of(document) == deformed);
}

void DocumentUndoTest::undo_of_a_mesh_brings_the_deformed_object_back() {
  Document document(grid_, QStringLiteral("sheet"));
  QVERIFY(has_settled(document));
  QVERIFY(drag_and_release(document, 31, {2.3, 2.3, 0}));
  const auto deformed = shapes_of(document);
  edits::replaceMesh(document, block_, QStringLiteral("block"), QStringLiteral("build block"));
  QVERIFY(has_settled(document));
  document.undo();
  QVERIFY(has_settled(document));
  QCOMPARE(document.mesh(), grid_);
  QVERIFY(shapes_of(document) == deformed);
}

void DocumentUndoTest::an_algorithm_that_did_not_fit_comes_back_with_its_mesh() {
  Document document(grid_, QStringLiteral("sheet"));
  edits::setAlgorithm(document, 0, Algorithm::chainmail_3d);
  QCOMPARE(document.algorithm(0), Algorithm::chainmail_3d);
  edits::replaceMesh(document, block_, QStringLiteral("block"), QStringLiteral("open block"));
  QVERIFY(has_settled(document));
  QCOMPARE(document.algorithm(0), Algorithm::natural_queue);
  document.undo();
  QVERIFY(has_settled(document));
  QCOMPARE(document.algorithm(0), Algorithm::chainmail_3d);
  QCOMPARE(document.solvers().frame(0)->statistics.algorithm, Algorithm::chainmail_3d);
}

/// An undo step of a removed panel has no effect, and undo of the steps before it still works.
void DocumentUndoTest::steps_of_a_removed_panel_are_undone() {
  Document document(grid_, QStringLiteral("sheet"));
  edits::setPinned(document, {3}, true);
  document.addPanel();
  QVERIFY(has_settled(document));
  edits::setAlgorithm(document, 2, Algorithm::spiral);
  document.removePanel();
  QVERIFY(has_settled(document));
  const std::array before{document.algorithm(0), document.algorithm(1)};
  document.undo();
  QVERIFY(has_settled(document));
  QCOMPARE(document.algorithm(0), before[0]);
  QCOMPARE(document.algorithm(1), before[1]);
  QCOMPARE(document.pins(), std::vector<ElementId>{3});
  document.undo();
  QVERIFY(has_settled(document));
  QVERIFY(document.pins().empty());
  document.redo();
  document.redo();
  QVERIFY(has_settled(document));
  QCOMPARE(document.panels(), 2);
}

CHAINMAIL_TEST(DocumentUndoTest)

}  // namespace chainmail::test_document_undo

#include "document_undo.moc"
