#include <QtTest>

#include "core/scenarios.h"
#include "core/threads.h"
#include "mesh/layers.h"
#include "mesh/progress.h"
#include "program.h"

namespace chainmail::test_preparing {

using namespace chainmail::test;

namespace {

constexpr LinkSoftness rigid{1, 1, 0};

std::vector<ElementId> sorted(std::span<const ElementId> elements) {
  std::vector<ElementId> result(elements.begin(), elements.end());
  std::ranges::sort(result);
  return result;
}

std::unique_ptr<Deformer> solver_of(const MeshPointer& mesh, Algorithm algorithm, const Softness& softness) {
  auto solver = std::make_unique<Deformer>(mesh, algorithm, Precision::single_precision);
  solver->body().set_softness(softness);
  return solver;
}

}  // namespace

/// The first pass of a drag may be prepared, and no result shows it.
class PreparingTest : public QObject {
  Q_OBJECT

 private slots:
  void changes_no_bit();
  void saves_the_search();
  void pins_that_stop_the_handle_are_found();
  void can_be_cancelled_data();
  void can_be_cancelled();
  void a_thread_prepares_what_it_is_told();
  void a_thread_prepares_nothing_between_commands();
  void relaxation_is_prepared_before_its_handle_moves();
  void a_slice_that_gives_way_leaves_no_trace();
};

void PreparingTest::changes_no_bit() {
  const auto holds = [] {
    const auto& mesh = draw_family().mesh;
    const auto all = algorithms();
    const Algorithm algorithm = all[*rc::gen::inRange<std::size_t>(0, all.size())].algorithm;
    RC_PRE(fits(algorithm, *mesh));
    const Softness softness = *rc::gen::arbitrary<bool>() ? draw_softness(*mesh) : Softness{rigid, {}};
    const auto cuts = draw_links(*mesh);
    const auto with = solver_of(mesh, algorithm, softness), without = solver_of(mesh, algorithm, softness);
    const ElementId pin = *rc::gen::inRange<ElementId>(0, 2 * mesh->element_count());
    for (const auto& solver : {with.get(), without.get()}) {
      solver->body().cut(cuts);
      if (pin < mesh->element_count()) {
        solver->body().pin(std::vector{pin});
      }
    }
    for (const DragStep& drag_step : *any_drag_steps(20)) {
      const ElementId element = drag_step.of(*mesh);
      with->prepare(element);
      if (element == pin) {
        continue;
      }
      // Two moves of each drag: the second one goes on from what the first one left.
      for (int i = 0; i < 2; ++i) {
        const PassCount one = move_by(*with, *mesh, element, drag_step.by());
        const PassCount other = move_by(*without, *mesh, element, drag_step.by());
        RC_ASSERT(one.checked == other.checked);
        RC_ASSERT(one.moved == other.moved);
        RC_ASSERT(sorted(with->moved()) == sorted(without->moved()));
        RC_ASSERT(same_bits(positions_of(*with, *mesh), positions_of(*without, *mesh)));
      }
    }
  };
  QVERIFY(check_property("a prepared drag ends in the same bits", holds));
}

void PreparingTest::saves_the_search() {
  const auto mesh = jittered_triangles(20, 20, 5);
  const auto solver = solver_of(mesh, Algorithm::exact, {rigid, {}});
  solver->prepare(210);
  const PassCount prepared = move_by(*solver, *mesh, 210, Point(1, 2, 0));
  QCOMPARE(prepared.moved, std::uint64_t{mesh->element_count() - 1});
  QCOMPARE(prepared.visits, std::uint64_t{0});
  QVERIFY(move_by(*solver, *mesh, 30, Point(1, 2, 0)).visits >= mesh->element_count());
}

void PreparingTest::pins_that_stop_the_handle_are_found() {
  const auto mesh = make_mesh(MeshKind::line, {20, 1, 1});
  const auto solver = solver_of(mesh, Algorithm::exact, {{0.5, 2, 0.5}, {}});
  solver->body().pin(std::vector<ElementId>{19});
  solver->prepare(0);
  QVERIFY(move_by(*solver, *mesh, 0, Point(-30, 0, 0)).stopped);
  QCOMPARE(position_of(*solver, *mesh, 0).x(), -19.0);  // 19 links of twice their length, from 19
}

void PreparingTest::can_be_cancelled_data() {
  QTest::addColumn<std::string>("algorithm");
  QTest::addColumn<bool>("mixed");
  QTest::addColumn<std::uint32_t>("side");
  for (const char* algorithm : {"natural-queue", "generalized", "exact"}) {
    QTest::addRow("%s", algorithm) << std::string(algorithm) << false << 120U;
    QTest::addRow("%s, softness per link", algorithm) << std::string(algorithm) << true << 120U;
  }
  QTest::addRow("exact, on threads") << std::string("exact") << false << 330U;
  QTest::addRow("exact, on threads, softness per link") << std::string("exact") << true << 330U;
}

void PreparingTest::can_be_cancelled() {
  QFETCH(std::string, algorithm);
  QFETCH(bool, mixed);
  QFETCH(std::uint32_t, side);
  const auto mesh = jittered_triangles(side, side, 3);
  Softness softness{{0.999, 1.001, 0.0005}, {}};  // every element still moves
  for (LinkId link = 0; mixed && link < mesh->link_count(); link += 2) {
    softness.links.set(link, {0.99, 1.01, 0.002});
  }
  const auto solver = solver_of(mesh, *find_algorithm(algorithm), softness);
  const auto other = solver_of(mesh, *find_algorithm(algorithm), softness);
  solver->set_threads(2);
  // Cancelled before it begins, and after some time: somewhere in the middle, or not at all.
  for (const auto after : {0us, 300us, 1000us, 3000us, 10'000us}) {
    const Progress job = Progress::watched();
    solver->set_progress(job);
    {
      job.cancel(after == 0us);
      const std::jthread canceller([&] {
        const auto end = std::chrono::steady_clock::now() + after;
        while (std::chrono::steady_clock::now() < end) {
        }
        job.cancel();
      });
      try {
        solver->prepare(side * side / 2);
      } catch (const Cancelled&) {
      }
    }
    solver->set_progress({});
    // Of another element: what the cancelled search left must not matter.
    for (const ElementId element : {17U, side * side - 30}) {
      solver->prepare(element);
      const PassCount count = move_by(*solver, *mesh, element, Point(2, 3, 0));
      QVERIFY(mixed || count.visits == 0);  // what was prepared is used
      move_by(*other, *mesh, element, Point(2, 3, 0));
      QVERIFY(same_bits(positions_of(*solver, *mesh), positions_of(*other, *mesh)));
    }
  }
}

void PreparingTest::a_thread_prepares_what_it_is_told() {
  const auto mesh = jittered_triangles(20, 20, 5);
  SolverThread solver(mesh, Algorithm::exact, [] {});
  solver.post(commands::SetSoftness{{rigid, {}}});
  const auto visits_of_a_drag = [&](ElementId element, std::uint64_t passes) {
    solver.post(commands::Grab{element});
    solver.post(commands::Drag{mesh->rest_position(element) + Point(double(passes), 2, 0)});
    solver.post(commands::Release{});
    return wait_for_passes(solver, passes) ? solver.latest_frame().statistics.last_pass.visits : ~std::uint64_t{0};
  };
  solver.prepare(210);
  QVERIFY(wait_until([&] { return solver.prepared() == 1; }));
  QCOMPARE(visits_of_a_drag(210, 1), std::uint64_t{0});
  solver.prepare(std::nullopt);
  QVERIFY(visits_of_a_drag(7, 2) >= mesh->element_count());
  // A command in between, and a pointer that stays: it is prepared again, for the new softness.
  solver.prepare(30);
  int prepared = solver.prepared();
  QVERIFY(wait_until([&] { return solver.prepared() > prepared; }));
  prepared = solver.prepared();
  solver.post(commands::SetSoftness{{{1, 1.001, 0}, {}}});
  QVERIFY(wait_until([&] { return solver.prepared() > prepared; }));
  QCOMPARE(visits_of_a_drag(30, 4), std::uint64_t{0});  // a new softness is a pass too
}

/// While commands come, nothing is prepared, however long the pointer has been on the element: the next command would
/// make it outdated.
void PreparingTest::a_thread_prepares_nothing_between_commands() {
  const auto mesh = jittered_triangles(8, 8, 5);
  SolverThread solver(mesh, Algorithm::exact, [] {});
  solver.prepare(30);
  QVERIFY(wait_until([&] { return solver.prepared() == 1; }));
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < 40; ++i) {
    const std::uint64_t before = solver.latest_frame().number;
    solver.post(commands::SetSoftness{{{1, 1 + 0.001 * (i % 2), 0}, {}}});
    QVERIFY(wait_until([&] { return solver.idle() && solver.latest_frame().number > before; }));
  }
  const int prepared = solver.prepared() - 1;
  // A machine that pauses gives it time. It waits for 80 ms without a command.
  QVERIFY2(prepared <= (std::chrono::steady_clock::now() - start) / 80ms, qPrintable(QString::number(prepared)));
}

/// Relaxation that is fine only where needed has nothing left to build at the first move, and no result shows it.
void PreparingTest::relaxation_is_prepared_before_its_handle_moves() {
  const MeshPointer mesh = generate({MeshKind::tetra, {18, 18, 18}, 1, {}});
  const Softness open{{0, 3, 2}, {}, EnergyKind::material};
  const commands::SetRelaxation on{true, 1, RelaxationScheme::equilibrium, false, true};
  const ElementId handle = mesh->element_count() - 1;
  std::vector<LinkId> wound;  // many links, which the cubes must know
  for (LinkId link = 0; link < mesh->link_count(); ++link) {
    const Point a = mesh->rest_position(mesh->links[link][0]), b = mesh->rest_position(mesh->links[link][1]);
    if ((a[0] < 8.5) != (b[0] < 8.5) && a[2] > 8 && b[2] > 8) {
      wound.push_back(link);
    }
  }
  for (const std::size_t cuts : {std::size_t{0}, std::size_t{100}, wound.size()}) {
    std::vector<std::vector<double>> ends;
    for (const bool prepares : {false, true}) {
      const auto solver = solver_of(mesh, Algorithm::exact, open);
      solver->body().pin(layer(*mesh, *find_side("left")));
      solver->set_relaxation(RelaxationScheme::equilibrium, true);
      QCOMPARE(prepares && solver->prepare_relaxation(), prepares);
      QVERIFY(!prepares || !solver->prepare_relaxation());
      solver->body().cut(std::span(wound).first(cuts));
      QCOMPARE(prepares && solver->prepare_relaxation(), prepares && cuts > 500);
      solver->wake_all();
      move_by(*solver, *mesh, handle, Point(0, 0, 2));
      QCOMPARE(solver->relax_slice(1, Deformer::elements_per_slice, std::array{handle}).has_prepared, !prepares);
      ends.push_back(positions_of(*solver, *mesh));
    }
    QVERIFY(ends[0] == ends[1]);
  }

  // A thread does it when it has nothing else to do, and again for another object.
  SolverThread solver(mesh, Algorithm::exact, [] {});
  solver.post(commands::SetSoftness{open});
  QVERIFY(wait_until([&] { return solver.settled(); }));
  QCOMPARE(solver.prepared(), 0);
  solver.post(on);
  QVERIFY(wait_until([&] { return solver.prepared() == 1; }));
  solver.post(commands::ReplaceMesh{generate({MeshKind::tetra, {17, 18, 18}, 1, {}})});
  QVERIFY(wait_until([&] { return solver.prepared() == 2; }));
}

/// What only an object at rest needs is given up when the handle moves on, at each place where that is possible. The
/// same moves without the pause end in the same bits.
void PreparingTest::a_slice_that_gives_way_leaves_no_trace() {
  const MeshPointer mesh = generate({MeshKind::tetra, {18, 18, 18}, 1, {}});
  const std::vector<ElementId> handle = layer(*mesh, *find_side("right"));
  int cancelled = 0;
  const auto end_of = [&](int reports) {
    const auto solver = solver_of(mesh, Algorithm::exact, {{0, 3, 2}, {}, EnergyKind::material});
    solver->body().pin(layer(*mesh, *find_side("left")));
    solver->set_relaxation(RelaxationScheme::equilibrium, true);
    solver->wake_all();
    const auto slice = [&] { solver->relax_slice(1, Deformer::elements_per_slice, handle); };
    Handle held(solver->body(), handle);
    for (const double by : {0.5, 1.0}) {
      solver->move(held, {held.pose().pivot + Point(0, 0, by), Point::Zero()});
      slice();  // follows the handle
      slice();  // writes the rest
      if (by == 0.5 && reports > 0) {
        Progress work;
        work = Progress::watched([&, left = reports](double, const std::string&) mutable {
          if (--left == 0) {
            work.cancel();
          }
        });
        solver->set_progress(work);
        try {
          slice();
        } catch (const Cancelled&) {
          ++cancelled;
        }
        solver->set_progress({});
        if (!solver->lacks_preparation()) {
          return std::vector<double>();  // it was not cancelled
        }
      }
    }
    slice();
    return positions_of(*solver, *mesh);
  };
  const std::vector<double> right = end_of(0);
  for (int reports = 1;; reports += 5) {
    const std::vector<double> end = end_of(reports);
    if (end.empty()) {
      break;
    }
    QVERIFY2(end == right, std::to_string(reports).c_str());
  }
  QVERIFY(cancelled > 5);
}

CHAINMAIL_TEST(PreparingTest)

}  // namespace chainmail::test_preparing

#include "test_preparing.moc"
