#include <QtTest>
#include <future>

#include "core/allocations.h"
#include "core/failing_method.h"
#include "core/no_threads.h"
#include "core/threads.h"
#include "exact/thread_team.h"
#include "mesh/error.h"
#include "program.h"
#include "simulate/frame_writer.h"
#include "simulate/pass_recorder.h"

namespace chainmail::test_failures {

using namespace chainmail::test;

/// Without memory, without threads, and after exceptions that nobody expects, a simulation and its thread go on.
class FailuresTest : public QObject {
  Q_OBJECT

 private slots:
  void a_sentence_says_what_failed();
  void a_method_that_fails_stops_alone_data();
  void a_method_that_fails_stops_alone();
  void a_question_that_fails_is_reported();
  void a_callback_that_fails_is_called_again();
  void a_frame_without_memory_comes_later();
  void a_state_without_memory_restores_cuts_and_pins();
  void a_pass_without_memory_for_its_record_is_a_pass();
  void a_solver_without_a_thread_says_so();
  void a_team_without_threads_and_memory_works_alone();
};

namespace {

// Smaller than the positions of a block, larger than what a command takes.
constexpr std::size_t less_than_a_block = 700;

MeshPointer grid() { return make_mesh(MeshKind::grid, {20, 20, 1}); }

std::string sentence_of(Failure failure) {
  try {
    fail(failure);
  } catch (...) {
    return failure_sentence("here");
  }
  return {};
}

bool begins(const std::string& text, const char* with) { return QString::fromStdString(text).startsWith(with); }

/// Waits for the next error of a solver, and returns it.
std::string next_error(SolverThread& solver) {
  std::string error;
  wait_until([&] { return !(error = solver.take_error()).empty(); });
  return error;
}

std::vector<double> positions_of(SolverThread& solver) {
  std::promise<std::vector<double>> positions;
  solver.ask([&](const Simulation& simulation) {
    std::vector<double> all(simulation.mesh().rest.size());
    simulation.body().copy_positions(std::span(all));
    positions.set_value(std::move(all));
  });
  return positions.get_future().get();
}

}  // namespace

void FailuresTest::a_sentence_says_what_failed() {
  QVERIFY(begins(sentence_of(Failure::memory), "here: there is not enough memory; save"));
  QVERIFY(begins(sentence_of(Failure::system), "here: the system refuses it (Resource temporarily unavailable); save"));
  QVERIFY(begins(sentence_of(Failure::other), "here: it failed (a surprise); save"));
  QVERIFY(begins(sentence_of(Failure::number), "here: it failed for an unknown reason; save"));
  try {
    throw Error("there", "it is wrong", "change it");
  } catch (...) {
    QCOMPARE(failure_sentence("here"), std::string("there: it is wrong; change it"));
  }
  try {
    throw std::bad_alloc();
  } catch (...) {
    const LittleMemory little(20);
    QCOMPARE(failure_sentence("here"), std::string("out of memory"));
  }
}

void FailuresTest::a_method_that_fails_stops_alone_data() {
  QTest::addColumn<Failure>("failure");
  QTest::newRow("no memory") << Failure::memory;
  QTest::newRow("no thread") << Failure::system;
  QTest::newRow("something else") << Failure::other;
  QTest::newRow("no exception class") << Failure::number;
}

/// The drag fails in its second move. Further moves are dropped; undo restores everything; the next drag tries again.
void FailuresTest::a_method_that_fails_stops_alone() {
  QFETCH(Failure, failure);
  const auto moves = std::make_shared<FailingMoves>();
  const ExtraAlgorithm extra(failing_entry(moves));
  const MeshPointer mesh = grid();
  SolverThread solver(mesh, failing_algorithm, [] {});
  solver.post(commands::KeepState{1});
  solver.post(commands::Grab{0});
  solver.post(commands::Drag{Point(-1, 0, 0)});
  QVERIFY(wait_for_passes(solver, 1));
  moves->failure = failure;
  solver.post(commands::Drag{Point(-2, 0, 0)});
  QVERIFY(begins(next_error(solver), "Failing: "));
  solver.post(commands::Drag{Point(-3, 0, 0)});
  QCOMPARE(positions_of(solver).front(), -2.0);
  QCOMPARE(moves->count.load(), 2);
  QVERIFY(wait_until([&] { return begins(solver.latest_frame().statistics.remark, "stopped: "); }));
  QCOMPARE(solver.latest_frame().positions.front(), -2.0F);
  solver.post(commands::Release{});
  solver.post(commands::RestoreState{1});
  QVERIFY(positions_of(solver) == mesh->rest);
  moves->failure = Failure::none;
  solver.post(commands::Grab{0});
  solver.post(commands::Drag{Point(-3, 0, 0)});
  QCOMPARE(positions_of(solver).front(), -3.0);
  QVERIFY(wait_until([&] { return solver.idle() && solver.latest_frame().statistics.remark.empty(); }));
}

void FailuresTest::a_question_that_fails_is_reported() {
  SolverThread solver(grid(), Algorithm::natural_queue, [] {});
  for (const Failure failure : {Failure::memory, Failure::other, Failure::number}) {
    solver.ask([failure](const Simulation&) { fail(failure); });
    QVERIFY(begins(next_error(solver), "Natural Queue"));
    QVERIFY(wait_until([&] { return solver.idle(); }));
  }
  QVERIFY(!positions_of(solver).empty());
}

void FailuresTest::a_callback_that_fails_is_called_again() {
  std::atomic<int> bad_frames = 0, bad_idles = 0, frames = 0, idles = 0;
  const auto call = [](std::atomic<int>& bad, std::atomic<int>& good) {
    return [&] {
      if (bad > 0) {
        --bad;
        throw std::bad_alloc();
      }
      ++good;
    };
  };
  SolverThread solver(grid(), Algorithm::natural_queue, call(bad_frames, frames), call(bad_idles, idles));
  bad_frames = 3;
  bad_idles = 1;
  frames = 0;
  solver.post(commands::Grab{0});
  solver.post(commands::Drag{Point(-1, 0, 0)});
  QVERIFY(wait_until([&] { return frames > 0 && idles > 0 && bad_frames == 0 && bad_idles == 0; }));
  QVERIFY(wait_for_passes(solver, 1));
}

void FailuresTest::a_frame_without_memory_comes_later() {
  Simulation simulation(grid(), Algorithm::natural_queue, Precision::single_precision);
  FrameExchange frames;
  FrameWriter writer(frames);
  const auto publish = [&] { writer.publish(simulation); };
  {
    const LittleMemory little(less_than_a_block);
    QVERIFY_THROWS_EXCEPTION(std::bad_alloc, publish());
  }
  publish();
  QVERIFY(frames.latest().mesh == simulation.mesh_pointer());
  const MeshPointer small = simulation.mesh_pointer();
  // A frame of a larger object fails; the smaller object comes back.
  simulation.apply(commands::KeepState{1});
  simulation.apply(commands::ReplaceMesh{make_mesh(MeshKind::grid, {100, 100, 1})});
  {
    const LittleMemory little(less_than_a_block);
    QVERIFY_THROWS_EXCEPTION(std::bad_alloc, publish());
  }
  QVERIFY(frames.latest().mesh == small);
  simulation.apply(commands::RestoreState{1});
  publish();
  const Frame& frame = frames.latest();
  QVERIFY(frame.mesh == small);
  QVERIFY(std::equal(frame.positions.begin(), frame.positions.end(), small->rest.begin(), small->rest.end()));
}

void FailuresTest::a_state_without_memory_restores_cuts_and_pins() {
  Simulation simulation(grid(), Algorithm::natural_queue, Precision::single_precision);
  const auto drag = [&](double x) {
    simulation.apply(commands::Grab{0});
    simulation.apply(commands::Drag{Point(x, 0, 0)});
    simulation.apply(commands::Release{});
  };
  drag(-5);
  simulation.apply(commands::KeepState{1});
  const auto kept = floats_of(simulation);
  drag(-9);
  simulation.apply(commands::Cut{{3}});
  {
    const LittleMemory little(less_than_a_block);
    QVERIFY_THROWS_EXCEPTION(Error, simulation.apply(commands::KeepState{2}));
  }
  simulation.apply(commands::Pin{{9}});
  simulation.apply(commands::Cut{{7}});
  simulation.apply(commands::RestoreState{2});
  QVERIFY(simulation.body().cuts().links() == std::vector<LinkId>{3});
  QVERIFY(simulation.body().pins().empty());
  QVERIFY(floats_of(simulation) == kept);  // the last positions for which there was memory
  drag(-9);
  const auto before = floats_of(simulation);
  simulation.apply(commands::KeepState{3});
  drag(4);
  simulation.apply(commands::RestoreState{3});
  QVERIFY(floats_of(simulation) == before);  // with memory, all is as always
}

void FailuresTest::a_pass_without_memory_for_its_record_is_a_pass() {
  Simulation simulation(grid(), Algorithm::natural_queue, Precision::single_precision);
  PassRecorder recorder;
  recorder.set_on(true);
  simulation.apply(commands::Grab{0});
  const auto drag = [&](double x) {
    const Command command = commands::Drag{Point(x, 0, 0)};
    recorder.begin(command, simulation);
    simulation.apply(command);
    recorder.end(simulation);
  };
  simulation.apply(commands::Drag{Point(-1, 0, 0)});  // the method allocates its memory
  {
    const LittleMemory little(less_than_a_block);
    drag(-2);
  }
  QVERIFY(recorder.last(0) == nullptr);
  QCOMPARE(simulation.statistics().passes, std::uint64_t{2});
  drag(-3);
  QVERIFY(recorder.last(0) != nullptr);
  QCOMPARE(recorder.last(0)->before.size(), simulation.mesh().rest.size());
}

void FailuresTest::a_solver_without_a_thread_says_so() {
  SolverThread first(grid(), Algorithm::natural_queue, [] {});
  {
    const NoThreads none;
    QVERIFY_THROWS_EXCEPTION(std::system_error, SolverThread(first, Algorithm::exact, [] {}));
  }
  SolverThread second(first, Algorithm::exact, [] {});
  QVERIFY(positions_of(second) == positions_of(first));
}

void FailuresTest::a_team_without_threads_and_memory_works_alone() {
  std::array<std::atomic<int>, 5> runs{};
  {
    const NoThreads none;
    const LittleMemory little(50);
    ThreadTeam team(8);
    team.call_helpers();
    team.run(runs.size(), [&](std::size_t part) { ++runs[part]; });
  }
  for (const auto& count : runs) {
    QCOMPARE(count.load(), 1);
  }
}

CHAINMAIL_TEST(FailuresTest)

}  // namespace chainmail::test_failures

#include "test_failures.moc"
