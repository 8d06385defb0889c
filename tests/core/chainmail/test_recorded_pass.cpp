#include <QtTest>

#include "core/any_command.h"
#include "core/chainmail/recorded.h"
#include "core/threads.h"
#include "program.h"
#include "solver/algorithms.h"

namespace chainmail::test_recorded_pass {

using namespace chainmail::test;

/// Recorded passes: their positions step by step, and the waiting list at each step.
class RecordedPassTest : public QObject {
  Q_OBJECT

 private slots:
  void steps_lead_from_before_to_after_data();
  void steps_lead_from_before_to_after();
  void each_step_clamps_into_the_region_about_the_sponsor();
  void the_next_one_on_the_list_is_the_one_that_is_taken();
  void the_lists_of_a_3x3_grid_by_hand();
  void three_d_chainmail_empties_one_list_after_another();
  void what_does_not_lead_through_the_list_is_not_known();
  void nothing_is_recorded_unless_it_is_asked_for();
  void another_thread_may_look_at_any_time();
};

namespace {

Softness mixed(const Mesh& mesh, std::mt19937_64& random) {
  Softness softness{{0.7, 1.3, 0.2}, {}};
  for (LinkId link = 0; link < mesh.link_count(); link += 3) {
    softness.links.set(link, {uniform(random, 0.2, 1), uniform(random, 1, 2), uniform(random, 0, 0.6)});
  }
  return softness;
}

/// Calls check for recorded passes of an algorithm on a mesh with cuts, a pin and mixed softness.
template <class Check>
void for_each_pass(const MeshPointer& mesh, Algorithm algorithm, Check check) {
  std::mt19937_64 random(17);
  Recorded recorded(mesh, algorithm);
  recorded.apply(commands::SetSoftness{mixed(*mesh, random)});
  recorded.apply(commands::Cut{{0, static_cast<LinkId>(random() % mesh->link_count())}});
  recorded.apply(commands::Pin{{mesh->element_count() - 1}});
  for (int i = 0; i < 6; ++i) {
    const auto element = static_cast<ElementId>(random() % (mesh->element_count() - 1));
    const Point by(uniform(random, -3, 3), uniform(random, -3, 3), uniform(random, -3, 3));
    const auto pass = recorded.drag(element, position_of(recorded.simulation, element) + by);
    if (pass) {  // pins may contradict each other
      check(*pass);
    }
  }
}

std::vector<ElementId> elements_at(const WaitingHistory& history, std::size_t step) {
  std::vector<ElementId> elements;
  for (const std::uint32_t i : history.at(step)) {
    elements.push_back(history.candidates()[i].element);
  }
  return elements;
}

}  // namespace

void RecordedPassTest::steps_lead_from_before_to_after_data() {
  QTest::addColumn<int>("family");
  const auto all = families();
  for (std::size_t i = 0; i < all.size(); ++i) {
    QTest::newRow(all[i].name.c_str()) << int(i);
  }
}

/// Anything may happen between passes: relaxation, edits, undo, other meshes and algorithms, and a recorder that is
/// turned off and on.
void RecordedPassTest::steps_lead_from_before_to_after() {
  QFETCH(int, family);
  const MeshPointer mesh = families()[std::size_t(family)].mesh;
  std::uint64_t passes = 0;
  AnyCommand any(41, true, {mesh, make_mesh(MeshKind::block, {3, 3, 2})}, 12, 14);
  Recorded recorded(mesh, Algorithm::generalized);
  for (int i = 0; i < 2000; ++i) {
    if (any.below(40) == 0) {
      recorded.recorder.set_on(false);
      QVERIFY(!recorded.recorder.last(0));
      recorded.recorder.set_on(any.below(2) == 0);
    }
    if (any.below(3) == 0) {
      recorded.publish();
    }
    const std::vector<float> before = floats_of(recorded.simulation);
    const auto passes_before = recorded.simulation.statistics().passes;
    recorded.apply(any.draw());
    const auto pass = recorded.recorder.last(0);
    if (pass && pass->number > passes_before) {
      ++passes;
      QVERIFY(pass->before == before);
      QVERIFY(played(*pass) == floats_of(recorded.simulation));
      QVERIFY(updated_once(*pass));
      QVERIFY(pass->number == recorded.simulation.statistics().passes);
      QVERIFY(pass->algorithm == recorded.simulation.statistics().algorithm);
      QVERIFY(!recorded.recorder.last(pass->number));
    }
    recorded.simulation.continue_relaxation();
    recorded.recorder.set_on(true);
  }
  QVERIFY(passes > 300);
}

void RecordedPassTest::each_step_clamps_into_the_region_about_the_sponsor() {
  for (const MeshFamily& family : families()) {
    for (const AlgorithmInfo& one : algorithms_for(*family.mesh)) {
      for_each_pass(family.mesh, one.algorithm, [&](const RecordedPass& pass) {
        Player player(pass);
        for (std::size_t row = 0; row < pass.trace.size() && one.algorithm != Algorithm::exact; ++row) {
          QCOMPARE(stays(pass, row), !pass.trace[row].moved);
          for (int k = 0; k < pass.mesh->space_dimension; ++k) {
            QCOMPARE(clamped_by_hand(player, row, k), pass.position_after(row)[std::size_t(k)]);
          }
          player.take(row);
        }
      });
    }
  }
}

void RecordedPassTest::the_next_one_on_the_list_is_the_one_that_is_taken() {
  for (const MeshFamily& family : families()) {
    for (const AlgorithmInfo& one : algorithms_for(*family.mesh)) {
      for_each_pass(family.mesh, one.algorithm, [&](const RecordedPass& pass) {
        const WaitingHistory history = waiting_history(pass);
        QCOMPARE(history.known(), one.algorithm != Algorithm::exact);
        if (history.known()) {
          QVERIFY2(leads_through(pass, history), std::string(one.name).c_str());
        }
      });
    }
  }
}

/// The drags of test_propagation, where the lists are worked out: nearly rigid, and far enough for all to move.
void RecordedPassTest::the_lists_of_a_3x3_grid_by_hand() {
  const auto mesh = make_mesh(MeshKind::grid, {3, 3, 1});
  const auto history_of = [&](Algorithm algorithm) {
    Recorded recorded(mesh, algorithm);
    recorded.apply(commands::SetSoftness{{{1, 1, 0}, {}}});
    return waiting_history(*recorded.drag(0, Point(-5, -5, 0)));
  };
  using List = std::vector<ElementId>;
  const auto generalized = history_of(Algorithm::generalized);
  QCOMPARE(elements_at(generalized, 0), (List{3, 1}));
  QCOMPARE(elements_at(generalized, 1), (List{6, 4, 0, 1}));
  QCOMPARE(elements_at(generalized, 2), (List{7, 3, 4, 0, 1}));
  QCOMPARE(elements_at(generalized, 4), (List{7, 5, 6, 4, 3, 4, 0, 1}));  // 6 4 before 3, by 7; 7 will be dropped
  const auto spiral = history_of(Algorithm::spiral);
  QCOMPARE(elements_at(spiral, 0), (List{1, 3}));
  QCOMPARE(elements_at(spiral, 1), (List{3, 0, 2, 4}));
  QCOMPARE(elements_at(spiral, 2), (List{0, 2, 4, 0, 4, 6}));
  const auto queue = history_of(Algorithm::natural_queue);
  QCOMPARE(elements_at(queue, 0), (List{1, 3}));
  QCOMPARE(elements_at(queue, 1), (List{3, 2, 4}));
  QCOMPARE(elements_at(queue, 2), (List{2, 4, 6}));
  QCOMPARE(elements_at(queue, 8), List{});
}

void RecordedPassTest::three_d_chainmail_empties_one_list_after_another() {
  const auto mesh = make_mesh(MeshKind::grid, {3, 3, 1});
  Recorded recorded(mesh, Algorithm::chainmail_3d);
  recorded.apply(commands::SetSoftness{{{1, 1, 0}, {}}});
  const WaitingHistory history = waiting_history(*recorded.drag(4, Point(5, 5, 0)));
  // Right, left, top, bottom of the centre. 5, on the right, feeds the lists right, top and bottom.
  QCOMPARE(elements_at(history, 0), (std::vector<ElementId>{5, 3, 7, 1}));
  QCOMPARE(elements_at(history, 1), (std::vector<ElementId>{3, 7, 8, 1, 2}));
}

void RecordedPassTest::what_does_not_lead_through_the_list_is_not_known() {
  Recorded recorded(make_mesh(MeshKind::grid, {4, 4, 1}), Algorithm::spiral);
  auto pass = recorded.drag(5, Point(4, 4, 0));
  QVERIFY(waiting_history(*pass).known());
  std::swap(pass->trace[1], pass->trace[3]);
  QVERIFY(!waiting_history(*pass).known());
}

void RecordedPassTest::nothing_is_recorded_unless_it_is_asked_for() {
  Recorded recorded(make_mesh(MeshKind::grid, {4, 4, 1}), Algorithm::spiral);
  recorded.recorder.set_on(false);
  QVERIFY(!recorded.drag(5, Point(4, 4, 0)));
  recorded.recorder.set_on(true);
  QVERIFY(!recorded.recorder.last(0));
  QVERIFY(recorded.drag(5, Point(0, 0, 0)));
  recorded.apply(commands::Release{});
  recorded.apply(commands::Grab{3});
  QVERIFY(recorded.recorder.last(0));  // only the handle changes
}

void RecordedPassTest::another_thread_may_look_at_any_time() {
  const auto mesh = make_mesh(MeshKind::cloth, {20, 20, 1});
  SolverThread solver(mesh, Algorithm::natural_queue, [] {});
  solver.record_passes(true);
  std::mt19937_64 random(3);
  std::uint64_t seen = 0, passes = 0;
  solver.post(commands::Grab{210});
  for (int i = 0; i < 400; ++i) {
    solver.post(commands::Drag{Point(uniform(random, 0, 20), uniform(random, 0, 20), 0)});
    ++passes;
    if (const auto pass = solver.last_pass(seen)) {
      QVERIFY(pass->number > seen);
      seen = pass->number;
      QVERIFY(waiting_history(*pass).known());
    }
    if (i % 100 == 50) {
      solver.record_passes(false);
      solver.record_passes(true);
    }
  }
  QVERIFY(wait_for_passes(solver, passes));
  const auto last = solver.last_pass(0);
  QVERIFY(last && last->number == passes);
  QVERIFY(played(*last) == solver.latest_frame().positions);
}

CHAINMAIL_TEST(RecordedPassTest)

}  // namespace chainmail::test_recorded_pass

#include "test_recorded_pass.moc"
