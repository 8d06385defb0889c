// Replay of a document: the recorded commands lead to the same object, bit by bit, and a drag can continue from any of
// them.

#include <QTest>

#include "document/edits.h"
#include "document/lesson_player.h"
#include "document_bench.h"
#include "files/session/session.h"
#include "mesh/generate.h"
#include "program.h"

namespace chainmail::test_document_replay {

namespace {

using Shapes = std::vector<std::vector<float>>;

/// Makes two drags with a cut and pins in between. Returns false if the solvers do not settle.
bool work(Document& document) {
  if (!has_settled(document) || !drag_and_release(document, 31, {1.7, 2.1, 0})) {
    return false;
  }
  edits::cut(document, {3, 4, 40});
  edits::setPinned(document, {0}, true);
  edits::setSoftness(document, {0.9, 1.1, 0.05}, QStringLiteral("stiffer"));
  return drag_and_release(document, 62, {0.9, 1.4, 0});
}

bool goes_to(Document& document, std::size_t position) {
  document.moves().goTo(position);
  return has_settled(document) && document.moves().history().position() == position;
}

}  // namespace

class DocumentReplayTest : public QObject {
  Q_OBJECT

 private slots:
  void a_replay_gives_identical_bits();
  void a_drag_continues_from_an_earlier_position();
  void a_move_goes_to_idle_solvers_at_once();
  void a_step_of_a_lesson_ends_after_its_relaxation();

 private:
  const MeshPointer mesh_ = generate({MeshKind::grid, {9, 7, 1}, 1, {}});
};

void DocumentReplayTest::a_replay_gives_identical_bits() {
  Document document(mesh_, QStringLiteral("sheet"));
  QVERIFY(work(document));
  const Shapes live = shapes_of(document);
  const MoveHistory& history = document.moves().history();
  const std::size_t length = history.length();
  QCOMPARE(history.position(), length);
  QVERIFY(goes_to(document, history.start()));
  const std::vector<float> rest(mesh_->rest.begin(), mesh_->rest.end());
  QVERIFY(shapes_of(document) == (Shapes{rest, rest}));
  QCOMPARE(document.cuts().count(), 0U);
  QVERIFY(document.pins().empty());
  QVERIFY(*document.wholeSoftness() == standard_softness());  // as the object was when it was new
  QCOMPARE(history.length(), length);
  QVERIFY(goes_to(document, length));
  QVERIFY(shapes_of(document) == live);
  QCOMPARE(document.cuts().count(), 3U);
  QCOMPARE(document.pins(), std::vector<ElementId>{0});
}

void DocumentReplayTest::a_drag_continues_from_an_earlier_position() {
  Document document(mesh_, QStringLiteral("sheet"));
  QVERIFY(work(document));
  const MoveHistory& history = document.moves().history();
  QVERIFY(goes_to(document, history.start()));
  QVERIFY(goes_to(document, 2));  // after the first move of the first drag
  QVERIFY(history.position() < history.length());
  QVERIFY(drag_and_release(document, 5, {-0.8, -1.1, 0}));
  QCOMPARE(history.position(), history.length());
  const Shapes live = shapes_of(document);
  QVERIFY(goes_to(document, history.start()));
  QVERIFY(shapes_of(document) != live);
  QVERIFY(goes_to(document, history.length()));
  QVERIFY(shapes_of(document) == live);
}

void DocumentReplayTest::a_move_goes_to_idle_solvers_at_once() {
  Document document(mesh_, QStringLiteral("sheet"));
  const MoveHistory& history = document.moves().history();
  document.handle().grab(31);
  const auto finish = [&document] {
    QVERIFY(QTest::qWaitFor([&document] { return document.solvers().idle(); }, longest_wait));
  };
  for (int i = 1; i <= 5; ++i) {
    finish();
    const std::size_t recorded = history.length();
    document.handle().drag(Point(4, 3 + 0.1 * i, 0));
    QCOMPARE(history.length(), recorded + 1);
  }
  // While a solver is busy, only the newest move waits.
  finish();
  std::promise<void> busy;
  document.solvers().ask(1, [end = busy.get_future().share()](const Simulation&) { end.wait(); });
  const std::size_t recorded = history.length();
  for (int i = 1; i <= 200; ++i) {
    document.handle().drag(Point(4, 4 + 0.01 * i, 0));
  }
  QCOMPARE(history.length(), recorded);
  busy.set_value();
  QVERIFY(has_settled(document));
  QCOMPARE(position_of(document, 1, 31), Point(4, 6, 0));
  QCOMPARE(history.length(), recorded + 1);
  document.handle().release();
}

/// The last command of each step relaxes. What was relaxed in idle time must not go on when a replay begins again. Each
/// panel has the state of a simulation of its own after the commands of the step.
void DocumentReplayTest::a_step_of_a_lesson_ends_after_its_relaxation() {
  constexpr std::array algorithms{Algorithm::natural_queue, Algorithm::exact};
  const auto slices = std::make_shared<commands::SliceCounts>(algorithms.size());
  slices->note(0, algorithms[0], 4);
  slices->note(1, algorithms[1], 7);
  const auto session = std::make_shared<Session>();
  session->mesh = mesh_;
  session->softness = std::make_shared<const Softness>();
  for (const Algorithm algorithm : algorithms) {
    session->panels.push_back({algorithm, Precision::single_precision, {}});
  }
  session->moves = {commands::Pin{{0, 9}},
                    commands::Grab{44},
                    commands::Drag{{1, -2, 0}, {}, true},
                    commands::Grab{60},
                    commands::Drag{{1, 1.5, 0}, {}, true},
                    commands::Relax{1},
                    commands::Drag{{1.2, 0.5, 0}, {}, true},
                    commands::Release{},
                    commands::Relax{20, 1, RelaxationScheme::equilibrium},
                    commands::Grab{62},
                    commands::Drag{{-1, 2, 0}, {}, true},
                    commands::Relaxed{RelaxationScheme::link, 0.5, commands::Relaxed::Start::awake, slices}};
  session->lesson.title = "a";
  for (const std::size_t until : {0U, 6U, 9U, 12U}) {
    session->lesson.steps.push_back({"b", "c", until, {}, {}, {}, {}, {}, {}});
  }
  const auto shapes_after = [&](std::size_t moves) {
    Shapes shapes;
    for (std::size_t panel = 0; panel < algorithms.size(); ++panel) {
      Simulation simulation(mesh_, algorithms[panel], Precision::single_precision);
      for (Command command : std::span(session->moves).first(moves)) {
        if (auto* relaxed = std::get_if<commands::Relaxed>(&command)) {
          relaxed->panel = panel;
        }
        simulation.apply(command);
      }
      std::vector<double> positions(mesh_->rest.size());
      simulation.body().copy_positions(std::span(positions));
      shapes.emplace_back(positions.begin(), positions.end());
    }
    return shapes;
  };
  Document document(mesh_, QStringLiteral("sheet"));
  Propagation propagation(document);
  LessonPlayer player(document, propagation);
  edits::restore(document, session, {}, QStringLiteral("open"));
  const auto shows = [&](std::size_t step) {
    return QTest::qWaitFor([&] { return !player.plays() && document.solvers().settled(); }, longest_wait) &&
           player.step() == step && shapes_of(document) == shapes_after(player.lesson().steps[step].until);
  };
  for (std::size_t step = 1; step < 4; ++step) {
    QVERIFY(shapes_after(player.lesson().steps[step].until - 1) != shapes_after(player.lesson().steps[step].until));
    player.next();  // plays the step
    QVERIFY2(shows(step), qPrintable(QStringLiteral("played, step %1").arg(step)));
  }
  for (std::size_t step = 3; step-- > 0;) {
    player.back();
    QVERIFY2(shows(step), qPrintable(QStringLiteral("back to step %1").arg(step)));
  }
  for (std::size_t step = 1; step < 4; ++step) {
    player.next();
    player.next();  // goes to its end at once
    QVERIFY2(shows(step), qPrintable(QStringLiteral("skipped, step %1").arg(step)));
  }
}

CHAINMAIL_TEST(DocumentReplayTest)

}  // namespace chainmail::test_document_replay

#include "document_replay.moc"
