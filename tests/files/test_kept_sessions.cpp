#include <QtTest>

#include "core/simulations.h"
#include "files/session_support.h"
#include "folders.h"
#include "program.h"
#include "simulate/move_history.h"

namespace chainmail::test_kept_sessions {

using namespace chainmail::test;

/// Sessions that the library of version 1.0.0 wrote open, and their moves lead to the positions that they have. Their
/// `ui` is made after its window: the bytes of moved docks are Qt's. The files must never be written again.
class KeptSessionsTest : public QObject {
  Q_OBJECT

 private slots:
  void they_open_and_replay_data();
  void they_open_and_replay();
  void every_file_is_expected();
  void texts_and_materials_come_back();
};

namespace {

/// What is in a file, known from what was done in the window.
struct Kept {
  const char* name;
  std::size_t elements, links, cells;
  std::size_t cuts, pins, own;  // own: links with their own softness
  std::size_t moves, done, panels;
  bool holds = false;    // a drag has begun
  double tolerance = 0;  // of the positions after a replay (mesh units); 0: to the bit
  LinkSoftness softness = {};
  EnergyKind energy = EnergyKind::corotated;
  commands::SetRelaxation relaxation = {};
};

constexpr double solved = 1e-5;  // methods of elasticity and the equilibrium iterate, and differ in rounding

const std::vector<Kept>& every_file() {
  using enum RelaxationScheme;
  static const std::vector<Kept> all{
      {"line", 12, 11, 0, 0, 0, 0, 7, 7, 2},
      {"plane", 30, 49, 0, 0, 0, 0, 7, 7, 2},
      {"space", 20, 43, 0, 0, 0, 0, 7, 7, 2},
      {"hexahedra", 16, 28, 3, 0, 4, 0, 5, 5, 2, false, solved},
      {"tetrahedra", 24, 81, 36, 0, 0, 0, 6, 6, 3},
      {"polygons", 12, 17, 0, 0, 0, 0, 3, 3, 2},
      {"order-of-neighbours", 5, 7, 0, 0, 0, 0, 3, 3, 2},
      {"picture", 9, 16, 0, 0, 0, 0, 3, 3, 2},
      {"drag-cut-off", 20, 31, 0, 0, 0, 0, 7, 7, 2, true},
      {"split", 31, 65, 0, 0, 0, 0, 7, 7, 2},
      {"split-undone", 16, 33, 0, 0, 1, 0, 8, 4, 2},
      {"pins", 25, 56, 0, 0, 2, 0, 8, 8, 2},
      {"cuts", 20, 31, 0, 2, 0, 0, 8, 8, 2},
      {"undone-moves", 16, 24, 0, 0, 0, 0, 10, 7, 2},
      {"materials", 18, 57, 24, 0, 6, 0, 5, 5, 3, false, solved, {0.9, 1.5, 0.25, 0.5, 3.5, -1}, EnergyKind::axial},
      {"softness-of-links",
       20,
       43,
       0,
       0,
       0,
       2,
       8,
       8,
       2,
       false,
       0,
       {0.5, 1.25, 0.1, 1.0 / 3, 1, 1},
       EnergyKind::isotropic},
      {"several-panels", 18, 33, 0, 0, 0, 0, 6, 6, 4},
      {"turned-handle", 24, 81, 36, 0, 0, 0, 5, 5, 2},
      {"axes-of-the-object", 4, 3, 0, 0, 0, 0, 4, 4, 2},
      {"relaxed-to-the-mean", 16, 33, 0, 0, 2, 0, 5, 5, 2, false, 0, {}, EnergyKind::corotated, {false, 0.25, mean}},
      {"relaxed-by-links", 16, 33, 0, 0, 2, 0, 5, 5, 2, false, 0, {}, EnergyKind::corotated, {true, 1, link}},
      {"relaxed-to-the-equilibrium",
       16,
       33,
       0,
       0,
       3,
       0,
       6,
       6,
       2,
       false,
       solved,
       {},
       EnergyKind::corotated,
       {false, 1, equilibrium}},
      {"lesson", 12, 23, 0, 0, 3, 0, 5, 1, 2},
      {"all-docks-moved", 12, 17, 0, 0, 0, 0, 3, 3, 2},
  };
  return all;
}

const std::filesystem::path folder = source_file("tests/files/sessions/version1");

Session kept(const std::string& name) { return read_session(folder / (name + ".chainmail")); }

/// Returns a simulation of a panel in which the moves were replayed.
Simulation replayed(const Session& session, const Session::Panel& panel) {
  Simulation simulation(first_mesh(session), panel.algorithm, panel.precision);
  simulation.apply(commands::SetElastic{session.elastic});
  simulation.apply(session.relaxation);
  for (std::size_t i = 0; i < session.moves_done; ++i) {
    simulation.apply(session.moves[i]);
  }
  return simulation;
}

/// Returns the largest difference between the positions of a panel and those after a replay.
double difference(const Session& session, const Session::Panel& panel) {
  Simulation simulation = replayed(session, panel);
  const auto ours = positions_of(simulation);
  simulation.apply(commands::SetPositions{std::make_shared<const Snapshot>(panel.positions)});
  const auto theirs = positions_of(simulation);
  double most = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    most = std::max(most, std::abs(ours[i] - theirs[i]));
  }
  return most;
}

}  // namespace

void KeptSessionsTest::they_open_and_replay_data() {
  QTest::addColumn<std::size_t>("row");
  for (std::size_t i = 0; i < every_file().size(); ++i) {
    QTest::newRow(every_file()[i].name) << i;
  }
}

void KeptSessionsTest::they_open_and_replay() {
  QFETCH(std::size_t, row);
  const Kept& expected = every_file()[row];
  const Session session = kept(expected.name);
  QCOMPARE(session.mesh->element_count(), expected.elements);
  QCOMPARE(session.mesh->link_count(), expected.links);
  QCOMPARE(session.mesh->tetrahedra.size() + session.mesh->hexahedra.size(), expected.cells);
  QCOMPARE(session.cuts.size(), expected.cuts);
  QCOMPARE(session.pins.size(), expected.pins);
  QCOMPARE(session.softness->links.size(), expected.own);
  QVERIFY(session.softness->global == expected.softness && session.softness->energy == expected.energy);
  QVERIFY(session.relaxation == expected.relaxation);
  QCOMPARE(session.moves.size(), expected.moves);
  QCOMPARE(session.moves_done, expected.done);
  MoveHistory history;
  history.load(session.moves);
  history.go_to(session.moves_done);
  QCOMPARE(history.holds(), expected.holds);
  QCOMPARE(session.panels.size(), expected.panels);
  for (const Session::Panel& panel : session.panels) {
    const double away = difference(session, panel);
    QVERIFY2(away <= expected.tolerance, qPrintable(QString::number(away)));
  }
  const std::string text = session_text(session);
  QCOMPARE(session_text(parse_session(text, "again.chainmail")), text);
}

void KeptSessionsTest::every_file_is_expected() {
  const auto files = std::distance(std::filesystem::directory_iterator(folder), {});
  QCOMPARE(std::size_t(files), every_file().size());
}

/// What is not a number in the table.
void KeptSessionsTest::texts_and_materials_come_back() {
  const Lesson lesson = kept("lesson").lesson;
  QCOMPARE(lesson.title, std::string("A small lesson"));
  QCOMPARE(lesson.steps.size(), std::size_t{3});
  QCOMPARE(lesson.steps[1].candidate, std::optional<std::uint32_t>(2));
  QCOMPARE(lesson.steps[2].until, std::size_t{5});
  QVERIFY((kept("materials").elastic == ElasticOptions{{2.5, 0.4}, {2, 3, 4}}));
  QVERIFY(kept("all-docks-moved").ui.find(R"("layout":"AAAA/wAAAAX9)") != std::string::npos);
  const auto picture = kept("picture").mesh->texture;
  QCOMPARE(picture->texels.size(), std::size_t{48});
  QCOMPARE(int(picture->texels[2]), 74);
  QCOMPARE(kept("order-of-neighbours").mesh->neighbours_of(0)[0], ElementId{3});
  QCOMPARE(kept("softness-of-links").softness->links.begin()->second, (LinkSoftness{1, 1, 0, 0.5, 10, 0}));
  QVERIFY(kept("axes-of-the-object").softness->axes.kind() == AxesKind::object);
  QVERIFY(kept("several-panels").panels[3].precision == Precision::double_precision);
}

CHAINMAIL_TEST(KeptSessionsTest)

}  // namespace chainmail::test_kept_sessions

#include "test_kept_sessions.moc"
