#include <QtTest>
#include <algorithm>

#include "core/api/api_support.h"
#include "mesh/generate.h"
#include "program.h"
#include "simulate/simulation.h"
#include "solver/deformer.h"

namespace chainmail::test_api_moves {

namespace {

/// The positions of a solver, x, y, z for each element.
std::vector<double> positions_of(const Deformer& solver) {
  std::vector<double> all;
  for (chainmail::ElementId e = 0; e < solver.body().mesh().element_count(); ++e) {
    const Point point = point_of(solver.body().mesh(), solver.body().positions(), e);
    all.insert(all.end(), point.begin(), point.end());
  }
  return all;
}

}  // namespace

/// The public interface: methods move as those of core do, and bad moves change nothing.
class ApiMovesTest : public QObject {
  Q_OBJECT

 private slots:
  void methods_are_those_of_the_table();
  void moves_equal_those_of_the_solver_data();
  void moves_equal_those_of_the_solver();
  void relaxation_equals_that_of_a_simulation();
  void moves_are_traced();
  void bad_moves_change_nothing();
  void one_call_deforms();
};

void ApiMovesTest::methods_are_those_of_the_table() {
  const auto all = cm::methods();
  QCOMPARE(all.size(), chainmail::every_algorithm().size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const AlgorithmInfo& one = chainmail::every_algorithm()[i];
    QCOMPARE(all[i].name, std::string(one.offered_name()));
    QCOMPARE(all[i].label, std::string(one.label));
    QCOMPARE(all[i].source, std::string(one.source));
    QCOMPARE(all[i].needs_pins, one.needs_pins);
    QCOMPARE(all[i].needs_grid, one.needs_grid);
    QVERIFY((all[i].family == cm::MethodFamily::elastic) == one.elastic.has_value());
  }
  QVERIFY(cm::method_info("exact").holds_links && !cm::method_info("exact").is_registered);
  QVERIFY(has(refusal_of([] { cm::method_info("magic"); }), "use one of generalized, spiral"));
  QVERIFY(has(cm::refusal("3d", cm::make_cloth(3, 3)), "only on grids"));
  QVERIFY(cm::refusal("3d", cm::make_grid(3, 3)).empty());
  QVERIFY(has(refusal_of([] { (void)cm::refusal("magic", cm::make_grid(3, 3)); }), "magic"));
}

void ApiMovesTest::moves_equal_those_of_the_solver_data() {
  QTest::addColumn<std::string>("method");
  QTest::addColumn<cm::Precision>("precision");
  for (const AlgorithmInfo& one : chainmail::every_algorithm()) {
    if (one.texts == nullptr) {
      QTest::addRow("%s, float", one.name.data()) << std::string(one.name) << cm::Precision::single_precision;
      QTest::addRow("%s, double", one.name.data()) << std::string(one.name) << cm::Precision::double_precision;
    }
  }
}

/// One element, then many with a rotation, on a mesh with pins, cuts and a stiff link.
void ApiMovesTest::moves_equal_those_of_the_solver() {
  QFETCH(std::string, method);
  QFETCH(cm::Precision, precision);
  const auto algorithm = *chainmail::find_algorithm(method);
  const bool is_grid = chainmail::info(algorithm).needs_grid;
  const MeshPointer mesh = is_grid ? generate({MeshKind::block, {5, 4, 3}}) : generate({MeshKind::tetra, {5, 4, 3}});
  const auto solver =
      std::make_unique<Deformer>(mesh, algorithm,
                                 precision == cm::Precision::single_precision ? chainmail::Precision::single_precision
                                                                              : chainmail::Precision::double_precision);
  cm::Deformer deformer(is_grid ? cm::make_block(5, 4, 3) : cm::make_tetra(5, 4, 3), method, precision);
  const std::vector<cm::ElementId> pins = deformer.body().mesh().side("left");
  deformer.body().pin(pins);
  solver->body().pin(pins);
  deformer.body().set_softness({.compression = 0.7, .stretch = 1.3, .shear = 0.05});
  deformer.body().set_softness({7}, {.compression = 1, .stretch = 1, .shear = 0});
  chainmail::Softness softness{{0.7, 1.3, 0.05}, {{7, {1, 1, 0}}}};
  solver->body().set_softness(softness);

  const cm::ElementId tip = 34;
  for (const double by : {0.3, 0.9, -0.4}) {
    const cm::Vector3 rest = deformer.body().mesh().rest_position(tip);
    const cm::MoveResult result = deformer.move(tip, rest + cm::Vector3{by, 0.5 * by, 0.1});
    const auto count = solver->move(tip, Point(rest.x + by, rest.y + 0.5 * by, rest.z + 0.1));
    QCOMPARE(result.moved, count.moved);
    QCOMPARE(result.checked, count.checked);
    QVERIFY(same_numbers(deformer.body().positions(), positions_of(*solver)));
    QVERIFY(std::ranges::equal(deformer.moved(), solver->moved()));
  }
  deformer.body().cut({20});
  solver->body().cut(std::vector<chainmail::LinkId>{20});
  const std::vector<cm::ElementId> right = deformer.body().mesh().side("right");
  cm::Handle handle = deformer.grab(right);
  chainmail::Handle inner(solver->body(), right);
  for (const double step : {0.5, 1.0}) {
    const chainmail::Rotation rotation{Point(1, 0, 0), 20 * step};
    const cm::Motion motion{{0.4 * step, 0, 0.1}, {{1, 0, 0}, 20 * step}};
    const cm::MoveResult result = deformer.move(handle, handle.after(motion));
    const auto count = solver->move(inner, {inner.grabbed().pivot + Point(0.4 * step, 0, 0.1), rotation.vector()});
    QCOMPARE(result.moved, count.moved);
    QCOMPARE(result.stopped, count.stopped);
    QCOMPARE(result.remark, solver->remark());
    QVERIFY(same_numbers(deformer.body().positions(), positions_of(*solver)));
  }
}

void ApiMovesTest::relaxation_equals_that_of_a_simulation() {
  for (const cm::RelaxationScheme scheme : {cm::RelaxationScheme::mean, cm::RelaxationScheme::link}) {
    cm::Deformer deformer(cm::make_grid(8, 8), "natural-queue");
    chainmail::Simulation simulation(generate({MeshKind::grid, {8, 8, 1}}), Algorithm::natural_queue,
                                     chainmail::Precision::double_precision);
    simulation.apply(chainmail::commands::SetRelaxation{
        false, 0.8,
        scheme == cm::RelaxationScheme::mean ? chainmail::RelaxationScheme::mean : chainmail::RelaxationScheme::link});
    simulation.apply(chainmail::commands::Grab{0});
    for (const double x : {-1.0, -4.0}) {
      deformer.move(0, {x, -2, 0});
      QCOMPARE(deformer.relax(3, {.step = 0.8, .scheme = scheme}), 3);
      simulation.apply(chainmail::commands::Drag{Point(x, -2, 0)});
      simulation.relax(3, {0.8, simulation.relaxation().scheme});
      QVERIFY(same_numbers(deformer.body().positions(), positions_of(simulation.solver())));
    }
    deformer.release();
    simulation.apply(chainmail::commands::Release{});
    QVERIFY(deformer.relax(5, {.scheme = scheme}) > 0);
    simulation.relax(5, {1, simulation.relaxation().scheme});
    QVERIFY(same_numbers(deformer.body().positions(), positions_of(simulation.solver())));
    QVERIFY((deformer.body().position(0) != cm::Vector3{-4, -2, 0}));  // it was released
    deformer.body().reset();
    QCOMPARE(deformer.relax(2), 0);  // nothing has moved since
  }
  cm::Deformer elastic(organ(), "fem");
  QCOMPARE(elastic.relax(3), 0);
}

void ApiMovesTest::moves_are_traced() {
  cm::Deformer deformer(cm::make_grid(4, 4), "natural-queue");
  deformer.move(0, {-2, 0, 0});
  QVERIFY(deformer.trace().empty());
  deformer.set_tracing(true);
  const auto solver = std::make_unique<Deformer>(generate({MeshKind::grid, {4, 4, 1}}), Algorithm::natural_queue,
                                                 chainmail::Precision::double_precision);
  solver->move(0, Point(-2, 0, 0));
  chainmail::Trace trace;
  const auto result = deformer.move(0, {-5, 1, 0});
  solver->move(0, Point(-5, 1, 0), &trace);
  QCOMPARE(deformer.trace().size(), trace.size());
  QCOMPARE(deformer.trace().size(), std::size_t(result.checked));
  for (std::size_t i = 0; i < trace.size(); ++i) {
    QCOMPARE(deformer.trace()[i].element, trace[i].element);
    QCOMPARE(deformer.trace()[i].sponsor, trace[i].sponsor);
    QCOMPARE(deformer.trace()[i].moved, trace[i].moved);
  }
  deformer.set_tracing(false);
  deformer.move(0, {-6, 1, 0});
  QVERIFY(deformer.trace().empty());
}

void ApiMovesTest::bad_moves_change_nothing() {
  cm::Deformer deformer(cm::make_grid(4, 4), "exact", cm::Precision::single_precision);
  deformer.body().pin({15});
  deformer.move(0, {-0.5, 0, 0});
  cm::Handle handle = deformer.grab({0, 1}), pinned = handle;
  const cm::Deformer other(cm::make_grid(4, 4), "exact");
  cm::Handle foreign = other.grab({0, 1});
  const State before(deformer.body());
  const auto refused = [&](auto act, const std::string& reason) {
    const std::string refusal = refusal_of(act);
    QVERIFY2(has(refusal, reason), refusal.c_str());
    QVERIFY2(State(deformer.body()) == before, reason.c_str());
    QCOMPARE(deformer.method(), std::string("exact"));
  };
  refused([] { cm::Deformer(cm::make_grid(2, 2), "magic"); }, "there is no such method");
  refused([] { cm::Deformer(cm::make_cloth(2, 2), "3d"); }, "only on grids");
  refused([&] { deformer.set_method("magic"); }, "there is no such method");
  refused([&] { deformer.set_method("bem"); }, "");
  refused([&] { deformer.move(16, {}); }, "element 16");
  refused([&] { deformer.move(15, {}); }, "it is pinned");
  refused([&] { deformer.move(0, {no_number, 0, 0}); }, "not a finite number");
  refused([&] { deformer.move(0, {1e38, 0, 0}); }, "out of the range of the precision");
  refused([&] { deformer.move(0, {0, 0, 1}); }, "does not extend along z");
  refused([&] { deformer.grab({}); }, "it has no elements");
  refused([&] { deformer.grab({0, 0}); }, "grabbed twice");
  refused([&] { deformer.grab({16}); }, "element 16");
  refused([&] { deformer.grab({15}); }, "pinned");
  refused([&] { deformer.move(foreign, foreign.grabbed()); }, "it is of another mesh");
  refused([&] { deformer.move(handle, {{0, no_number, 0}, {}}); }, "not a finite number");
  refused([&] { deformer.move(handle, handle.after({{}, {{0, 1, 0}, 10}})); }, "leave the space");
  refused([&] { deformer.move(handle, handle.after({{}, {{0, 0, 0}, 10}})); }, "no axis");
  refused([&] { deformer.move(handle, handle.after({{}, {{0, 0, 1}, no_number}})); }, "not a finite number");
  refused([&] { deformer.relax(-1); }, "below 0");
  refused([&] { deformer.set_threads(0); }, "below 1");
  refused([&] { deformer.relax(1, {.step = 0}); }, "relax-step");
  refused([&] { deformer.relax(1, {.until = 2}); }, "relax-until");
  QVERIFY(handle.pose() == pinned.pose());
}

void ApiMovesTest::one_call_deforms() {
  cm::Deformer deformer(organ(), "natural-queue");
  cm::Handle handle = deformer.grab({0, 4});
  deformer.move(handle, handle.after({{-2, 0, 1}, {}}));
  QVERIFY(same_numbers(cm::deform(organ(), "natural-queue", {0, 4}, {-2, 0, 1}), deformer.body().positions()));
  QVERIFY(has(refusal_of([] { cm::deform(organ(), "natural-queue", {0}, {no_number, 0, 0}); }), "not a finite number"));
}

CHAINMAIL_TEST(ApiMovesTest)

}  // namespace chainmail::test_api_moves

#include "test_api_moves.moc"
