#include <QtTest>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <utility>

#include "core/support.h"
#include "measure/violation.h"
#include "mesh/error.h"
#include "mesh/layers.h"
#include "program.h"

namespace chainmail::test_deformer {

using namespace chainmail::test;

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// Returns the message of the error that an act throws.
template <class Act>
std::string refusal_of(Act act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

bool has(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

/// Returns x, y and z of each element.
std::vector<double> points_of(const Deformer& deformer) {
  std::vector<double> points;
  const Body& body = deformer.body();
  for (ElementId e = 0; e < body.mesh().element_count(); ++e) {
    const Point at = point_of(body.mesh(), body.positions(), e);
    points.insert(points.end(), at.begin(), at.end());
  }
  return points;
}

}  // namespace

/// What a program hands to a deformer: it goes in and comes out, and bad input changes nothing.
class DeformerTest : public QObject {
  Q_OBJECT

 private slots:
  void positions_go_in_and_out();
  void copies_are_independent_data();
  void copies_are_independent();
  void a_random_life_stays_valid_and_a_copy_lives_alike_data() { copies_are_independent_data(); }
  void a_random_life_stays_valid_and_a_copy_lives_alike();
  void another_energy_wakes_the_object();
  void bad_moves_change_nothing();
  void bad_input_changes_nothing();
  void sides_have_names();
};

void DeformerTest::positions_go_in_and_out() {
  for (const Precision precision : precisions) {
    Deformer deformer(make_mesh(MeshKind::grid, {4, 3, 1}), Algorithm::natural_queue, precision);
    const std::vector<double> rest = points_of(deformer);
    std::vector<double> moved = rest;
    for (std::size_t i = 0; i < moved.size(); ++i) {
      moved[i] += i % 3 == 2 ? 0 : 0.5 * double(i);
    }
    deformer.move(0, {-3, 0, 0});
    deformer.set_positions(moved);
    QVERIFY(same_bits(points_of(deformer), moved));
    QVERIFY(deformer.held().empty() && deformer.last_handle().empty());
    const Snapshot snapshot = deformer.body().snapshot();
    deformer.reset();
    QVERIFY(same_bits(points_of(deformer), rest));
    deformer.restore(snapshot);
    QVERIFY(same_bits(points_of(deformer), moved));
  }
}

void DeformerTest::copies_are_independent_data() {
  QTest::addColumn<Algorithm>("algorithm");
  for (const AlgorithmInfo& one : algorithms()) {
    QTest::newRow(std::string(one.name).c_str()) << one.algorithm;
  }
}

/// A copy moves as the deformer that it was copied from, and neither notices the other.
void DeformerTest::copies_are_independent() {
  QFETCH(Algorithm, algorithm);
  Deformer deformer(make_mesh(MeshKind::grid, {6, 5, 1}), algorithm);
  deformer.pin(std::vector<ElementId>{29});
  deformer.cut(std::vector<LinkId>{3});
  deformer.move(0, {-4, -3, 0});
  Deformer copy = deformer.copy();
  const std::vector<double> before = points_of(deformer);
  QVERIFY(same_bits(points_of(copy), before));
  QVERIFY(copy.body().cuts().count() == 1 && copy.body().pins().size() == 1 && copy.last_handle().size() == 1);
  copy.move(0, {-6, 2, 0});
  QVERIFY(same_bits(points_of(deformer), before));
  deformer.move(0, {-6, 2, 0});
  QVERIFY(same_bits(points_of(deformer), points_of(copy)));
  copy.unpin(std::vector<ElementId>{29});
  QVERIFY(deformer.body().is_pinned(29));
}

/// Moves, cuts, pins, relaxation and restored positions in random order, the same ones in every run.
void DeformerTest::a_random_life_stays_valid_and_a_copy_lives_alike() {
  QFETCH(Algorithm, algorithm);
  const MeshPointer mesh = make_mesh(MeshKind::grid, {6, 5, 1});
  Deformer deformer(mesh, algorithm);
  std::mt19937_64 random(2004);
  const auto below = [&](std::uint32_t count) { return std::uint32_t(random() % count); };
  Snapshot kept = deformer.body().snapshot();
  for (int step = 0; step < 200; ++step) {
    const std::vector<ElementId> element{below(mesh->element_count())};
    const std::vector<LinkId> link{below(mesh->link_count())};
    const Point target = mesh->rest_position(element[0]) + Point(below(7), below(7), 0) - Point(3, 3, 0);
    switch (below(8)) {
      case 0:
        deformer.cut(link);
        deformer.pin(element);
        break;
      case 1:
        deformer.relax(2);
        break;
      case 2:
        deformer.restore(std::exchange(kept, deformer.body().snapshot()));
        break;
      default: {
        deformer.unpin(element);
        Deformer copy = deformer.copy();
        const PassCount count = deformer.move(element[0], target), again = copy.move(element[0], target);
        const auto one = positions_of(deformer, *mesh), other = positions_of(copy, *mesh);
        const bool is_exact = algorithm == Algorithm::exact;  // it keeps regions, which round in their own way
        QVERIFY(is_exact ? largest_step(one, other) <= 1e-12 * (1 + largest_coordinate(one)) : same_bits(one, other));
        QVERIFY(is_exact || (count.moved == again.moved && count.checked == again.checked));
      }
    }
    const std::vector<double> positions = positions_of(deformer, *mesh);
    QVERIFY(std::ranges::all_of(positions, [](double x) { return std::isfinite(x); }));
    QVERIFY(!info(algorithm).holds_links || measure_violation(deformer.body()).fraction == 0);
  }
}

void DeformerTest::another_energy_wakes_the_object() {
  Deformer deformer(make_mesh(MeshKind::grid, {5, 5, 1}), Algorithm::natural_queue);
  deformer.move(0, {-4, -3, 0});
  deformer.relax(1000);
  Softness softness = deformer.body().softness();
  QCOMPARE(deformer.relax_slice(1, 1000, {}).visited, std::uint64_t(0));
  set_energy(softness, EnergyKind::axial);
  deformer.set_softness(softness);
  QVERIFY(deformer.relax_slice(1, 1000, {}).visited > 0);
}

void DeformerTest::bad_moves_change_nothing() {
  const MeshPointer mesh = make_mesh(MeshKind::grid, {4, 4, 1});
  Deformer deformer(mesh, Algorithm::exact, Precision::single_precision);
  deformer.pin(std::vector<ElementId>{15});
  deformer.move(0, {-0.5, 0, 0});
  Handle handle(deformer.body(), {0, 1});
  const Pose pose = handle.pose();
  const std::vector<double> before = points_of(deformer);
  const auto refused = [&](auto act, const std::string& reason) {
    const std::string refusal = refusal_of(act);
    QVERIFY2(has(refusal, reason), refusal.c_str());
    QVERIFY(same_bits(points_of(deformer), before) && handle.pose() == pose);
  };
  refused([&] { deformer.move(16, Point::Zero()); }, "element 16");
  refused([&] { deformer.move(15, Point::Zero()); }, "it is pinned");
  refused([&] { deformer.move(0, Point(1e38, 0, 0)); }, "out of the range of the precision");
  refused([&] { Handle(deformer.body(), {}); }, "it has no elements");
  refused([&] { Handle(deformer.body(), {0, 0}); }, "grabbed twice");
  refused([&] { deformer.set_algorithm(Algorithm::boundary_elements); }, "");
  refused([&] { deformer.relax(-1); }, "below 0");
  refused([&] { deformer.relax(1, {.step = 0}); }, "relax-step");
  refused([&] { deformer.relax(1, {.until = 2}); }, "relax-until");
  QVERIFY(deformer.algorithm() == Algorithm::exact);
}

void DeformerTest::bad_input_changes_nothing() {
  Deformer deformer(make_mesh(MeshKind::grid, {3, 3, 1}), Algorithm::natural_queue, Precision::single_precision);
  const std::vector<double> before = points_of(deformer);
  const auto with = [&](std::size_t at, double value) {
    std::vector<double> positions = before;
    positions[at] = value;
    return positions;
  };
  const auto refused = [&](auto act, const std::string& reason) {
    const std::string refusal = refusal_of(act);
    QVERIFY2(has(refusal, reason), refusal.c_str());
    QVERIFY(same_bits(points_of(deformer), before));
  };
  refused([&] { deformer.set_positions(std::vector<double>(26)); }, "there are 26 numbers for 9 elements");
  refused([&] { deformer.set_positions(with(4, no_number)); }, "positions, element 1");
  refused([&] { deformer.set_positions(with(25, 1e38)); }, "positions, element 8");
  refused([&] { deformer.set_positions(with(5, 1)); }, "does not extend along z");
  const Mesh& mesh = deformer.body().mesh();
  refused([&] { check_position(mesh, "target", {no_number, 0, 0}); }, "target: a coordinate is not a finite number");
  refused([&] { check_displacement(mesh, "by", {0, 0, 1}); }, "by: the object does not extend along z");
  refused([&] { axes_after({{1, 0, 0}, 30}, mesh); }, "frame: turned about x");
  Deformer large(make_mesh(MeshKind::grid, {9, 9, 1}), Algorithm::natural_queue);
  large.move(80, {9, 9, 0});
  Handle of_another(large.body(), {80});
  refused([&] { deformer.move(of_another, {}); }, "element 80");
  refused([&] { deformer.restore(large.body().snapshot()); }, "positions");
  refused([&] { deformer.set_threads(0); }, "threads: the number is below 1");
  refused([&] { deformer.prepare(9); }, "element 9");
  Handle own(deformer.body(), {0, 1});
  refused([&] { deformer.move(own, {{1, 1, 0}, {1, 0, 0}}); }, "rotation: about x");
  Softness wrong;
  wrong.global.stretch = 0.5;
  refused([&] { deformer.set_softness(wrong); }, "stretch");
  refused([&] { algorithm_of("magic"); }, "method 'magic': there is no such method; use one of generalized");

  Softness softness;
  const Softness none = softness;
  const std::vector<LinkSoftness> two(2, {.stretch = 2});
  set_own(softness, mesh, std::vector<LinkId>{3, 1}, two);
  QVERIFY(softness.of(3).stretch == 2 && softness.of(0) == LinkSoftness() && softness.links.size() == 2);
  const auto refuses_links = [&](const std::vector<LinkId>& links, const LinkSoftness& own, const char* reason) {
    softness = none;
    refused([&] { set_own(softness, mesh, links, std::vector<LinkSoftness>(links.size(), own)); }, reason);
    QVERIFY(softness == none);
  };
  refuses_links({0, 0}, {}, "link 0: it is given twice");
  refuses_links({12}, {}, "link 12: there is no such link");
  refuses_links({5}, {.stretch = 0.9}, "link 5, stretch");
}

void DeformerTest::sides_have_names() {
  const MeshPointer grid = make_mesh(MeshKind::grid, {4, 3, 1});
  QVERIFY((elements_at(*grid, "left") == std::vector<ElementId>{0, 4, 8}));
  QCOMPARE(elements_at(*grid, "boundary").size(), std::size_t(10));
  QVERIFY(has(refusal_of([&] { elements_at(*grid, "upper"); }), "use left, right"));
  QVERIFY(has(refusal_of([&] { elements_at(*grid, "front"); }), "does not extend along that axis"));
}

CHAINMAIL_TEST(DeformerTest)

}  // namespace chainmail::test_deformer

#include "test_deformer.moc"
