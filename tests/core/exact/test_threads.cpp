#include <QtTest>
#include <atomic>
#include <new>

#include "core/scenarios.h"
#include "core/threads.h"
#include "exact/exact.h"
#include "exact/thread_team.h"
#include "program.h"

namespace chainmail::test_threads {

using namespace chainmail::test;

namespace {

/// Divides small objects too.
template <class Scalar>
struct AlwaysShared : AdaptiveSchedule<Scalar> {
  static constexpr std::size_t min_to_share = 0;
};

/// What some passes of Exact ChainMail leave.
struct Outcome {
  std::vector<double> positions;
  std::vector<std::vector<ElementId>> moved;  // of each pass, ascending
  bool operator==(const Outcome& other) const { return same_bits(positions, other.positions) && moved == other.moved; }
};

template <int Dimension>
Outcome passes(const MeshPointer& mesh, const Softness& softness, const std::vector<LinkId>& cuts,
               const std::vector<DragStep>& drag_steps, int threads) {
  Body held(mesh, Precision::double_precision);
  held.store_displacements(true);
  held.set_softness(softness);
  held.cut(cuts);
  auto body = held.view<double, Dimension>();
  ExactPropagation<double, Dimension, AlwaysShared<double>> exact;
  Outcome outcome;
  std::vector<ElementId> moved;
  for (const DragStep& drag_step : drag_steps) {
    const Handle handle(held, {drag_step.of(*mesh)});
    HandleMove move{handle, {handle.grabbed().pivot + drag_step.by(), Point::Zero()}};
    exact.propagate(body, move, moved, nullptr, threads);
    outcome.moved.push_back(moved);
    std::ranges::sort(outcome.moved.back());
  }
  outcome.positions.resize(mesh->rest.size());
  held.copy_positions(std::span(outcome.positions));
  return outcome;
}

Outcome passes(const MeshPointer& mesh, const Softness& softness, const std::vector<LinkId>& cuts,
               const std::vector<DragStep>& drag_steps, int threads) {
  return mesh->space_dimension == 1   ? passes<1>(mesh, softness, cuts, drag_steps, threads)
         : mesh->space_dimension == 2 ? passes<2>(mesh, softness, cuts, drag_steps, threads)
                                      : passes<3>(mesh, softness, cuts, drag_steps, threads);
}

/// A drag of a large object with some threads: of one element, then of some, which also turn.
std::vector<double> large_drag(const MeshPointer& mesh, const Softness& softness, int threads, bool pinned) {
  const auto solver = std::make_unique<Deformer>(mesh, Algorithm::exact, Precision::single_precision);
  solver->set_threads(threads);
  solver->body().set_softness(softness);
  if (pinned) {
    solver->body().pin(std::vector<ElementId>{mesh->element_count() - 1});
  }
  const ElementId middle = mesh->element_count() / 2;
  for (const double way : {3.0, 40.0, -25.0}) {
    move_by(*solver, *mesh, middle, Point(way, way / 2, 0));
  }
  Handle some(solver->body(), {middle, middle + 1, middle + 2});
  solver->move(some, {some.grabbed().pivot + Point(-20, 5, 0), Point(0, 0, 0.2)});
  return positions_of(*solver, *mesh);
}

}  // namespace

/// Threads share passes, and no result shows it.
class ThreadsTest : public QObject {
  Q_OBJECT

 private slots:
  void shares_change_no_bit();
  void threads_change_no_bit_data();
  void threads_change_no_bit();
  void every_part_runs_once();
  void an_error_of_a_part_arrives();
  void helpers_still_come_after_many_passes();
};

void ThreadsTest::shares_change_no_bit() {
  const auto holds = [] {
    const auto& mesh = draw_family().mesh;
    const Softness softness = draw_softness(*mesh);
    const auto cuts = draw_links(*mesh);
    const auto drag_steps = *any_drag_steps(40);
    const Outcome alone = passes(mesh, softness, cuts, drag_steps, 1);
    for (const int threads : {2, 3, 8}) {
      RC_ASSERT(passes(mesh, softness, cuts, drag_steps, threads) == alone);
    }
  };
  QVERIFY(check_property("a search in shares ends in the same bits and moves the same elements", holds));
}

void ThreadsTest::threads_change_no_bit_data() {
  QTest::addColumn<bool>("mixed");
  QTest::addColumn<bool>("pinned");
  QTest::addRow("uniform softness") << false << false;
  QTest::addRow("softness per link") << true << false;
  QTest::addRow("with a pin") << false << true;
}

void ThreadsTest::threads_change_no_bit() {
  QFETCH(bool, mixed);
  QFETCH(bool, pinned);
  const auto mesh = jittered_triangles(330, 330, 3);
  QVERIFY(mesh->element_count() >= AdaptiveSchedule<float>::min_to_share);
  Softness softness{{0.9, 1.1, 0.1}, {}};
  if (mixed) {
    for (LinkId link = 0; link < mesh->link_count(); link += 3) {
      softness.links.set(link, {0.7, 1.4, 0.3});
    }
  }
  const auto alone = large_drag(mesh, softness, 1, pinned);
  for (const int threads : {2, 8}) {
    QVERIFY(same_bits(large_drag(mesh, softness, threads, pinned), alone));
  }
}

void ThreadsTest::every_part_runs_once() {
  const RunningPass running;
  ThreadTeam team(4);
  team.call_helpers();
  for (int round = 0; round < 2000; ++round) {
    std::array<std::atomic<int>, 7> runs{};
    team.run(runs.size(), [&](std::size_t part) { ++runs[part]; });
    for (const auto& count : runs) {
      QCOMPARE(count.load(), 1);
    }
    if (round == 1000) {
      const RunningPass other, third;  // the helpers leave
      team.run(runs.size(), [&](std::size_t part) { ++runs[part]; });
      QCOMPARE(runs[6].load(), 2);
    }
  }
}

void ThreadsTest::an_error_of_a_part_arrives() {
  ThreadTeam team(2);
  team.call_helpers();
  for (std::size_t bad = 0; bad < 5; ++bad) {
    const auto work = [bad](std::size_t part) {
      if (part == bad) {
        throw std::bad_alloc();
      }
    };
    QVERIFY_THROWS_EXCEPTION(std::bad_alloc, team.run(5, work));
  }
  int done = 0;
  team.run(1, [&](std::size_t) { ++done; });
  QCOMPARE(done, 1);
}

namespace {

/// Runs a pass of two parts, each of which waits until the other one has begun. Returns true if both did at once.
bool two_threads_share_a_pass() {
  const RunningPass running;
  ThreadTeam team(2);
  team.call_helpers();
  std::atomic<int> begun = 0, met = 0;
  team.run(2, [&](std::size_t) {
    ++begun;
    met += wait_until([&] { return begun == 2; }) ? 1 : 0;
  });
  return met == 2;
}

}  // namespace

/// A helper is free again after a pass, whether it came in time for that pass or not.
void ThreadsTest::helpers_still_come_after_many_passes() {
  if (std::thread::hardware_concurrency() < 2) {
    QSKIP("a machine with one core has no helpers");
  }
  QVERIFY(two_threads_share_a_pass());
  for (int pass = 0; pass < 5000; ++pass) {
    const RunningPass running;
    ThreadTeam team(core_count());
    team.call_helpers();
    team.run(2, [](std::size_t) {});  // most of them end before the helper is awake
  }
  for (int pass = 0; pass < 100; ++pass) {
    QVERIFY(two_threads_share_a_pass());
  }
}

CHAINMAIL_TEST(ThreadsTest)

}  // namespace chainmail::test_threads

#include "test_threads.moc"
