#include <QtTest>

#include "core/scenarios.h"
#include "mesh/cuts.h"
#include "program.h"

namespace chainmail::test_cuts {

using namespace chainmail::test;

/// Cutting, and that uncutting restores the object exactly.
class CutsTest : public QObject {
  Q_OBJECT

 private slots:
  void counts_and_lists_what_is_cut();
  void knows_the_elements_it_touches();
  void cut_and_uncut_is_the_identity();
  void a_cut_link_carries_nothing();
  void disconnected_parts_do_not_move();
};

namespace {

/// Makes the same moves in two solvers. Returns true if they give the same bits, and the same candidates in the same
/// order.
bool move_alike(Deformer& one, Deformer& other, const Mesh& mesh, const std::vector<DragStep>& drag_steps) {
  for (const DragStep& drag_step : drag_steps) {
    const Point target = position_of(one, mesh, drag_step.of(mesh)) + drag_step.by();
    Trace first, second;
    one.move(drag_step.of(mesh), target, &first);
    other.move(drag_step.of(mesh), target, &second);
    if (first != second || !same_bits(positions_of(one, mesh), positions_of(other, mesh))) {
      return false;
    }
  }
  return true;
}

/// Returns the elements that uncut links join to `start`.
std::vector<bool> connected_to(const Mesh& mesh, const Cuts& cuts, ElementId start) {
  std::vector<bool> reached(mesh.element_count());
  reached[start] = true;
  for (bool grows = true; grows;) {
    grows = false;
    for (LinkId link = 0; link < mesh.link_count(); ++link) {
      const auto [a, b] = mesh.links[link];
      if (!cuts.is_cut(link) && reached[a] != reached[b]) {
        reached[a] = reached[b] = grows = true;
      }
    }
  }
  return reached;
}

}  // namespace

void CutsTest::counts_and_lists_what_is_cut() {
  Cuts cuts(make_mesh(MeshKind::grid, {20, 20, 1}));
  QCOMPARE(cuts.count(), 0u);
  QVERIFY(!cuts.is_cut(5) && cuts.links().empty());
  for (const LinkId link : {300u, 5u, 63u, 64u, 5u}) {  // 5 is cut already
    cuts.cut(link);
  }
  QCOMPARE(cuts.links(), (std::vector<LinkId>{5, 63, 64, 300}));
  cuts.uncut(63);
  cuts.uncut(62);  // was not cut
  QCOMPARE(cuts.links(), (std::vector<LinkId>{5, 64, 300}));
  QCOMPARE(cuts.count(), 3u);
}

void CutsTest::knows_the_elements_it_touches() {
  const auto mesh = make_mesh(MeshKind::line, {5, 1, 1});  // link i joins i and i + 1
  Cuts cuts(mesh);
  cuts.cut(1);
  cuts.cut(2);
  QVERIFY(!cuts.touches(0) && cuts.touches(1) && cuts.touches(2) && cuts.touches(3) && !cuts.touches(4));
  cuts.uncut(1);
  QVERIFY(!cuts.touches(1) && cuts.touches(2) && cuts.touches(3));
  cuts.uncut(2);
  QVERIFY(!cuts.touches(2) && !cuts.touches(3));
}

void CutsTest::cut_and_uncut_is_the_identity() {
  const auto holds = [] {
    const auto& mesh = draw_family().mesh;
    const auto algorithm = *any_algorithm();
    const auto precision = *any_precision();
    const auto untouched = std::make_unique<Deformer>(mesh, algorithm, precision);
    const auto mended = std::make_unique<Deformer>(mesh, algorithm, precision);
    const auto drag_steps = *any_drag_steps();
    RC_ASSERT(move_alike(*untouched, *mended, *mesh, drag_steps));
    const auto links = draw_links(*mesh);
    mended->body().cut(links);
    RC_ASSERT(mended->body().cuts().count() > 0 || links.empty());
    mended->body().uncut(links);
    RC_ASSERT(mended->body().cuts().count() == 0u);
    RC_ASSERT(move_alike(*untouched, *mended, *mesh, drag_steps));
  };
  QVERIFY(check_property("later moves give the same bits and the same trace", holds));
}

void CutsTest::a_cut_link_carries_nothing() {
  const auto mesh = make_mesh(MeshKind::line, {4, 1, 1});
  for (const AlgorithmInfo& one : algorithms_for(*mesh)) {
    if (one.algorithm == Algorithm::exact) {
      continue;  // it repairs the link between the parts after uncutting: another test covers this
    }
    const auto solver = std::make_unique<Deformer>(mesh, one.algorithm, Precision::double_precision);
    const LinkId middle = *find_link(*mesh, 1, 2);
    solver->body().cut(std::span(&middle, 1));
    solver->move(0, Point(-5, 0, 0));
    // 1 follows 0 at a stretch of 1.2. 2 and 3 are now another part.
    QCOMPARE(positions_of(*solver, *mesh), (std::vector<double>{-5, -3.8, 2, 3}));
    solver->body().uncut(std::span(&middle, 1));
    QCOMPARE(positions_of(*solver, *mesh), (std::vector<double>{-5, -3.8, 2, 3}));
    solver->move(0, Point(-5, 0, 0));  // 1 is already valid, so nothing else moves
    QCOMPARE(solver->body().positions()(2, 0), 2.0);
  }
}

void CutsTest::disconnected_parts_do_not_move() {
  const auto holds = [] {
    const auto& mesh = draw_family().mesh;
    const auto solver = std::make_unique<Deformer>(mesh, *any_algorithm(), *any_precision());
    solver->body().cut(draw_links(*mesh));
    const auto drag_step = *any_drag_step(80);
    const auto before = positions_of(*solver, *mesh);
    move_by(*solver, *mesh, drag_step.of(*mesh), drag_step.by());
    const auto after = positions_of(*solver, *mesh);
    const auto connected = connected_to(*mesh, solver->body().cuts(), drag_step.of(*mesh));
    for (std::size_t i = 0; i < before.size(); ++i) {
      RC_ASSERT(connected[i / mesh->space_dimension] || before[i] == after[i]);
    }
  };
  QVERIFY(check_property("elements that no link joins to the handle stay", holds));
}

CHAINMAIL_TEST(CutsTest)

}  // namespace chainmail::test_cuts

#include "test_cuts.moc"
