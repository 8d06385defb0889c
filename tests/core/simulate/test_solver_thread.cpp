#include <QtTest>
#include <ctime>
#include <future>

#include "core/threads.h"
#include "program.h"

namespace chainmail::test_solver_thread {

using namespace chainmail::test;

/// Longest time that ending may take. Sanitizers make everything slower.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr auto promised = 20s;
#else
constexpr auto promised = 2s;
#endif

/// A simulation on a thread of its own: commands in order, frames handed over, asleep at rest.
class SolverThreadTest : public QObject {
  Q_OBJECT

 private slots:
  void a_frame_is_there_from_the_start();
  void commands_give_what_a_simulation_gives();
  void a_refused_command_leaves_a_sentence();
  void the_frame_shows_another_mesh();
  void it_sleeps_when_nothing_is_to_do_data();
  void it_sleeps_when_nothing_is_to_do();
  void frames_come_at_most_60_times_a_second();
  void a_long_drag_of_a_large_mesh_is_seen_from_its_beginning_data();
  void a_long_drag_of_a_large_mesh_is_seen_from_its_beginning();
  void it_announces_that_it_became_idle();
  void it_ends_without_finishing_the_commands();
  void it_answers_questions_when_it_ends();
  void a_pass_that_takes_long_is_given_up_for_another_algorithm();
  void it_ends_in_the_middle_of_sweeps();
  void sweeps_end_where_nobody_needs_the_rest_data();
  void sweeps_end_where_nobody_needs_the_rest();
  void sweeps_that_were_posted_are_cut_and_no_others();
  void abandoned_it_answers_for_the_object_as_it_is();
  void another_goes_on_from_where_one_stands();
  void another_ends_with_the_one_it_waits_for();
  void a_frame_exchange_hands_over_the_newest_frame();
  void a_frame_exchange_never_mixes_two_frames();
};

namespace {

MeshPointer small_grid() { return make_mesh(MeshKind::grid, {8, 8, 1}); }

}  // namespace

void SolverThreadTest::a_frame_is_there_from_the_start() {
  std::atomic<int> frames = 0;
  const auto mesh = small_grid();
  SolverThread solver(mesh, Algorithm::generalized, [&] { ++frames; });
  QVERIFY(solver.idle());
  QVERIFY(wait_until([&] { return frames > 0; }));
  const Frame& frame = solver.latest_frame();
  QVERIFY(frame.mesh == mesh);
  QVERIFY(std::equal(frame.positions.begin(), frame.positions.end(), mesh->rest.begin(), mesh->rest.end()));
  QVERIFY(frame.statistics.algorithm == Algorithm::generalized);
  QVERIFY(frame.number > 0);
}

void SolverThreadTest::commands_give_what_a_simulation_gives() {
  std::mt19937_64 random(11);
  const auto mesh = jittered_triangles(12, 12, 7);
  for (const AlgorithmInfo& one : algorithms_for(*mesh)) {
    SolverThread solver(mesh, one.algorithm, [] {});
    Simulation simulation(mesh, one.algorithm, Precision::single_precision);
    const auto both = [&](const Command& command) {
      simulation.apply(command);
      solver.post(command);
    };
    for (int i = 0; i < 200; ++i) {
      const auto link = static_cast<LinkId>(random() % mesh->link_count());
      both(i % 3 == 0 ? Command(commands::Cut{{link}}) : Command(commands::Uncut{{link}}));
      both(commands::Grab{static_cast<ElementId>(random() % mesh->element_count())});
      both(commands::Drag{Point(uniform(random, -5, 15), uniform(random, -5, 15), 0)});
    }
    QVERIFY(wait_for_passes(solver, simulation.statistics().passes));
    QVERIFY(solver.latest_frame().positions == floats_of(simulation));
  }
}

void SolverThreadTest::a_refused_command_leaves_a_sentence() {
  SolverThread solver(small_grid(), Algorithm::natural_queue, [] {});
  QVERIFY(solver.take_error().empty());
  solver.post(commands::Grab{64});
  solver.post(commands::Grab{63});
  solver.post(commands::Drag{Point(9, 9, 0)});
  QVERIFY(wait_for_passes(solver, 1));  // the solver continues
  QVERIFY(QString::fromStdString(solver.take_error()).startsWith("element 64: "));
  QVERIFY(solver.take_error().empty());  // reported once
}

void SolverThreadTest::the_frame_shows_another_mesh() {
  SolverThread solver(small_grid(), Algorithm::natural_queue, [] {});
  const auto tetra = make_mesh(MeshKind::tetra, {3, 3, 3});
  solver.post(commands::ReplaceMesh{tetra});
  QVERIFY(wait_until([&] { return solver.latest_frame().mesh == tetra; }));
  QCOMPARE(solver.latest_frame().positions.size(), tetra->rest.size());
}

void SolverThreadTest::it_sleeps_when_nothing_is_to_do_data() {
  QTest::addColumn<bool>("relaxed");
  QTest::newRow("after a drag") << false;
  QTest::newRow("after a drag and its relaxation") << true;
}

void SolverThreadTest::it_sleeps_when_nothing_is_to_do() {
  QFETCH(bool, relaxed);
  std::atomic<int> frames = 0;
  SolverThread solver(small_grid(), Algorithm::natural_queue, [&] { ++frames; });
  solver.post(commands::SetRelaxation{relaxed, 1});
  solver.post(commands::Grab{0});
  solver.post(commands::Drag{Point(-3, -2, 0)});
  QVERIFY(wait_for_passes(solver, 1));
  // It comes to rest. Then it produces neither a frame nor work while another solver shows a drag of many moves. It
  // does not matter how long this takes, but a solver that never sleeps never gets there.
  SolverThread other(small_grid(), Algorithm::natural_queue, [] {});
  other.post(commands::Grab{0});
  std::uint64_t drags = 0;
  const auto asleep = [&] {
    const int before = frames;
    const std::clock_t spent = std::clock();
    for (int i = 0; i < 20; ++i) {
      ++drags;
      other.post(commands::Drag{Point(-1.0 * static_cast<double>(drags), 0, 0)});
      const bool shown = wait_until([&] {
        const Statistics& statistics = other.latest_frame().statistics;
        return statistics.passes == drags && statistics.violation.is_whole;
      });
      if (!shown) {
        return false;
      }
    }
    return frames == before && std::clock() - spent < CLOCKS_PER_SEC / 10;
  };
  QVERIFY(wait_until([&] { return asleep() && asleep(); }));
  QVERIFY(!solver.latest_frame().statistics.relaxing);
  QVERIFY(solver.latest_frame().statistics.violation.is_whole);
  solver.post(commands::Drag{Point(1, 1, 0)});  // and it wakes
  QVERIFY(wait_for_passes(solver, 2));
}

void SolverThreadTest::frames_come_at_most_60_times_a_second() {
  std::atomic<int> frames = 0;
  SolverThread solver(small_grid(), Algorithm::natural_queue, [&] { ++frames; });
  solver.post(commands::Grab{0});
  QVERIFY(wait_until([&] { return solver.idle(); }));
  frames = 0;
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < 300; ++i) {
    solver.post(commands::Drag{Point(-0.01 * i, 0, 0)});
    QVERIFY(wait_until([&] { return solver.idle(); }));
  }
  const int counted = frames;
  const auto elapsed = std::chrono::steady_clock::now() - start;
  // One frame every 16 ms, and a frame of rest at either end.
  QVERIFY2(counted <= elapsed / 16ms + 3, qPrintable(QString("%1 frames").arg(counted)));
}

void SolverThreadTest::a_long_drag_of_a_large_mesh_is_seen_from_its_beginning_data() {
  QTest::addColumn<bool>("relaxed");
  QTest::newRow("without relaxation") << false;
  QTest::newRow("with relaxation") << true;
}

/// Each pass takes some milliseconds. The first frame comes after a few of them, not after all, and does not wait until
/// the whole mesh is measured.
void SolverThreadTest::a_long_drag_of_a_large_mesh_is_seen_from_its_beginning() {
  QFETCH(const bool, relaxed);
  constexpr int moves = 1000;
  std::atomic<SolverThread*> reader = nullptr;
  std::promise<Statistics> first;
  bool has_first = false;  // only the solver's thread uses it
  SolverThread solver(make_mesh(MeshKind::grid, {300, 300, 1}), Algorithm::natural_queue, [&] {
    SolverThread* const one = reader;
    if (one != nullptr && !has_first && one->latest_frame().statistics.passes > 0) {
      has_first = true;
      first.set_value(one->latest_frame().statistics);
    }
  });
  reader = &solver;
  solver.post(commands::SetRelaxation{relaxed, 1});
  QVERIFY(wait_until([&] { return solver.settled(); }));  // the next frame shows the drag
  std::promise<void> all_are_posted;
  solver.ask([posted = all_are_posted.get_future().share()](const Simulation&) { posted.wait(); });
  solver.post(commands::Grab{0});
  for (int i = 0; i < moves; ++i) {
    solver.post(commands::Drag{i % 2 == 0 ? Point(-900, -700, 0) : Point(900, 700, 0)});
  }
  all_are_posted.set_value();
  auto answer = first.get_future();
  QVERIFY(answer.wait_for(30s) == std::future_status::ready);
  const Statistics seen = answer.get();
  QVERIFY2(seen.passes <= moves / 2, qPrintable(QString("%1 passes").arg(seen.passes)));
  QVERIFY(!seen.violation.is_whole && seen.violation.links > 0);
}

void SolverThreadTest::it_announces_that_it_became_idle() {
  std::atomic<int> announced = 0;
  SolverThread solver(
      small_grid(), Algorithm::natural_queue, [] {}, [&] { ++announced; });
  solver.post(commands::Grab{0});
  QVERIFY(wait_until([&] { return announced == 1; }));
  QVERIFY(solver.idle());
  solver.ask([](const Simulation&) {});
  QVERIFY(wait_until([&] { return announced == 2; }));
}

void SolverThreadTest::it_ends_without_finishing_the_commands() {
  // A pass over this chain moves 20,000 elements: all passes would take some ten seconds.
  auto solver =
      std::make_unique<SolverThread>(make_mesh(MeshKind::line, {20'000, 1, 1}), Algorithm::natural_queue, [] {});
  solver->post(commands::Grab{0});
  for (int i = 0; i < 50'000; ++i) {
    solver->post(commands::Drag{Point(i % 2 == 0 ? -10'000 : 40'000, 0, 0)});
  }
  const auto start = std::chrono::steady_clock::now();
  solver.reset();
  QVERIFY(std::chrono::steady_clock::now() - start < promised);
}

/// A session that is saved while the window closes asks for positions, and gets those of the object that was requested
/// last.
void SolverThreadTest::it_answers_questions_when_it_ends() {
  const auto next = make_mesh(MeshKind::grid, {7, 5, 1});
  auto solver =
      std::make_unique<SolverThread>(make_mesh(MeshKind::line, {20'000, 1, 1}), Algorithm::natural_queue, [] {});
  solver->post(commands::Grab{0});
  for (int i = 0; i < 10'000; ++i) {
    solver->post(commands::Drag{Point(i % 2 == 0 ? -10'000 : 40'000, 0, 0)});
  }
  solver->post(commands::ReplaceMesh{next});
  std::promise<ElementId> elements;
  auto answer = elements.get_future();
  solver->ask([&](const Simulation& simulation) { elements.set_value(simulation.mesh().element_count()); });
  solver.reset();
  QVERIFY(answer.wait_for(0s) == std::future_status::ready);
  QCOMPARE(answer.get(), next->element_count());
}

/// If the user already asked for something else, a finite element solution of some seconds must not block it.
void SolverThreadTest::a_pass_that_takes_long_is_given_up_for_another_algorithm() {
  const auto mesh = make_mesh(MeshKind::tetra, {20, 15, 15});
  SolverThread solver(mesh, Algorithm::neo_hookean, [] {});
  std::vector<ElementId> pins;
  for (ElementId e = 0; e < mesh->element_count(); e += 20) {
    pins.push_back(e);
  }
  solver.post(commands::Pin{pins});
  solver.post(commands::Grab{mesh->element_count() - 1});
  solver.post(commands::Drag{Point(22, 17, 16)});
  solver.post(commands::SetAlgorithm{Algorithm::natural_queue});
  QVERIFY(wait_until([&] { return solver.settled(); }));
  QCOMPARE(solver.latest_frame().statistics.passes, std::uint64_t(0));
  solver.post(commands::Drag{Point(22, 17, 16)});
  QVERIFY(wait_for_passes(solver, 1));
  QVERIFY(solver.take_error().empty());
}

/// Starts sweeps that would take hours.
void sweep_for_hours(SolverThread& solver) {
  solver.post(commands::KeepState{1});
  solver.post(commands::Grab{0});
  solver.post(commands::Drag{Point(-900, -700, 0)});
  solver.post(commands::Relax{1'000'000, 1, RelaxationScheme::mean});
  QVERIFY(wait_until([&] { return solver.waiting() == 1; }));
}

void SolverThreadTest::it_ends_in_the_middle_of_sweeps() {
  auto solver =
      std::make_unique<SolverThread>(make_mesh(MeshKind::grid, {300, 300, 1}), Algorithm::natural_queue, [] {});
  sweep_for_hours(*solver);
  const auto start = std::chrono::steady_clock::now();
  solver.reset();
  QVERIFY(std::chrono::steady_clock::now() - start < promised);
}

void SolverThreadTest::sweeps_end_where_nobody_needs_the_rest_data() {
  QTest::addColumn<Command>("next");
  const auto mesh = make_mesh(MeshKind::grid, {9, 9, 1});
  QTest::newRow("another algorithm") << Command(commands::SetAlgorithm{Algorithm::exact});
  QTest::newRow("another mesh") << Command(commands::ReplaceMesh{mesh});
}

void SolverThreadTest::sweeps_end_where_nobody_needs_the_rest() {
  QFETCH(Command, next);
  SolverThread solver(make_mesh(MeshKind::grid, {300, 300, 1}), Algorithm::natural_queue, [] {});
  sweep_for_hours(solver);
  solver.post(next);
  QVERIFY(wait_until([&] { return solver.idle(); }));
  QVERIFY(solver.take_error().empty());
}

void SolverThreadTest::sweeps_that_were_posted_are_cut_and_no_others() {
  const auto mesh = make_mesh(MeshKind::grid, {300, 300, 1});
  SolverThread solver(mesh, Algorithm::natural_queue, [] {});
  Simulation simulation(mesh, Algorithm::natural_queue, Precision::single_precision);
  sweep_for_hours(solver);
  solver.post(commands::Relax{1'000'000, 1, RelaxationScheme::mean});
  solver.cut_sweeps();
  const std::vector<Command> then{commands::RestoreState{1}, commands::Grab{0}, commands::Drag{Point(-90, -70, 0)},
                                  commands::Relax{5, 1, RelaxationScheme::mean}};
  simulation.apply(commands::KeepState{1});
  for (const Command& command : then) {
    solver.post(command);
    simulation.apply(command);
  }
  QVERIFY(wait_until([&] { return solver.settled(); }));
  QVERIFY(solver.latest_frame().positions == floats_of(simulation));
}

void SolverThreadTest::abandoned_it_answers_for_the_object_as_it_is() {
  const auto mesh = make_mesh(MeshKind::grid, {300, 300, 1});
  SolverThread solver(mesh, Algorithm::natural_queue, [] {});
  sweep_for_hours(solver);
  for (int i = 0; i < 100'000; ++i) {
    solver.post(commands::Drag{Point(i % 2 == 0 ? -900 : 900, 0, 0)});
  }
  std::promise<Snapshot> snapshot;
  solver.ask([&](const Simulation& simulation) { snapshot.set_value(simulation.snapshot()); });
  solver.abandon();
  auto answer = snapshot.get_future();
  QVERIFY(answer.wait_for(30s) == std::future_status::ready);
  QVERIFY(!answer.get().is_at_rest());  // from the drag before the sweeps
  QVERIFY(wait_until([&] { return solver.idle(); }));
  QVERIFY(solver.latest_frame().statistics.passes <= 1);  // the last frame may be from before that drag
}

void SolverThreadTest::another_goes_on_from_where_one_stands() {
  const auto mesh = jittered_triangles(12, 12, 7);
  SolverThread first(mesh, Algorithm::natural_queue, [] {});
  first.post(commands::Cut{{3, 4}});
  first.post(commands::KeepState{1});
  first.post(commands::Pin{{5}});
  first.post(commands::Grab{70});
  first.post(commands::Drag{Point(9, 2, 0)});
  SolverThread second(first, Algorithm::natural_queue, [] {});
  SolverThread third(first, Algorithm::enhanced, [] {});
  const auto idle = [&] { return first.idle() && second.idle() && third.idle(); };
  const auto same = [&](SolverThread& other) {
    const Frame &a = first.latest_frame(), &b = other.latest_frame();
    return a.mesh == b.mesh && a.positions == b.positions;
  };
  QVERIFY(wait_until([&] { return idle() && same(second) && same(third); }));
  const std::vector<float> at_rest(mesh->rest.begin(), mesh->rest.end());
  QVERIFY(first.latest_frame().positions != at_rest);
  QVERIFY(third.latest_frame().statistics.algorithm == Algorithm::enhanced);
  // The element stays grabbed, the pin stays, and the states that were kept for undo are there too.
  const auto all = [&](const Command& command) {
    for (SolverThread* one : {&first, &second, &third}) {
      one->post(command);
    }
  };
  all(commands::Drag{Point(-4, 7, 0)});
  QVERIFY(wait_until([&] { return idle() && second.latest_frame().statistics.passes == 1; }));
  QVERIFY(wait_until([&] { return same(second); }));
  all(commands::RestoreState{1});
  QVERIFY(wait_until([&] {
    return first.latest_frame().positions == at_rest && second.latest_frame().positions == at_rest &&
           third.latest_frame().positions == at_rest;
  }));
  for (SolverThread* one : {&first, &second, &third}) {
    QCOMPARE(one->take_error(), std::string());
  }
}

void SolverThreadTest::another_ends_with_the_one_it_waits_for() {
  auto first = std::make_unique<SolverThread>(make_mesh(MeshKind::grid, {512, 512, 1}), Algorithm::generalized, [] {});
  for (int i = 0; i < 1000; ++i) {
    first->post(commands::Grab{0});
    first->post(commands::Drag{Point(-double(i), 0, 0)});
  }
  SolverThread second(*first, Algorithm::natural_queue, [] {});
  first.reset();  // before most of its commands have run
  QVERIFY(wait_until([&] { return second.idle(); }));
}

void SolverThreadTest::a_frame_exchange_hands_over_the_newest_frame() {
  FrameExchange frames;
  const auto publish = [&](std::uint64_t number) {
    frames.begin().number = number;
    frames.publish();
  };
  QCOMPARE(frames.latest().number, std::uint64_t{0});
  publish(1);
  QCOMPARE(frames.latest().number, std::uint64_t{1});
  QCOMPARE(frames.latest().number, std::uint64_t{1});  // stays the same
  publish(2);
  publish(3);
  publish(4);
  QCOMPARE(frames.latest().number, std::uint64_t{4});
  const Frame& held = frames.latest();
  publish(5);
  publish(6);
  QCOMPARE(held.number, std::uint64_t{4});  // valid until the reader asks for another one
  frames.begin().number = 7;
  QCOMPARE(frames.latest().number, std::uint64_t{4});  // not one that is being filled
  frames.publish();
  QCOMPARE(frames.latest().number, std::uint64_t{7});
}

void SolverThreadTest::a_frame_exchange_never_mixes_two_frames() {
  constexpr std::uint64_t count = 20'000;
  FrameExchange frames;
  std::jthread writer([&] {
    for (std::uint64_t number = 1; number <= count; ++number) {
      Frame& frame = frames.begin();
      frame.number = number;
      frame.positions.assign(16, static_cast<float>(number));
      frames.publish();
    }
  });
  for (std::uint64_t last = 0; last != count;) {
    const Frame& frame = frames.latest();
    QVERIFY(frame.number >= last);
    last = frame.number;
    QVERIFY(std::all_of(frame.positions.begin(), frame.positions.end(),
                        [last](float x) { return x == static_cast<float>(last); }));
  }
}

CHAINMAIL_TEST(SolverThreadTest)

}  // namespace chainmail::test_solver_thread

#include "test_solver_thread.moc"
