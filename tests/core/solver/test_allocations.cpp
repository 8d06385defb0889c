// Checks that neither a pass nor relaxation allocates memory after warm-up, with any algorithm.

#include <QTest>
#include <numbers>

#include "core/allocations.h"
#include "core/families.h"
#include "mesh/layers.h"

using namespace chainmail;
using namespace chainmail::test;

// Eigen takes memory by malloc.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
extern "C" void* __libc_malloc(std::size_t bytes);
extern "C" void* malloc(std::size_t bytes) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(bytes);
}
#endif

namespace {

constexpr LinkSoftness stiff{0.999, 1.001, 0.0005};
constexpr int rounds_to_warm_up = 10;

/// Calls move(way) for the ways around a circle, round after round, and returns the number of allocations. The first
/// rounds are not counted: lists grow in them. The list of Generalized still grows in the third round, because that
/// algorithm does not return to its start.
template <class Move>
std::uint64_t taken_around(double radius, Move move) {
  const auto round = [&] {
    for (int i = 0; i < 16; ++i) {
      const double angle = std::numbers::pi * i / 8;
      move(radius * Point(std::cos(angle), std::sin(angle), 0));
    }
  };
  for (int i = 0; i < rounds_to_warm_up; ++i) {
    round();
  }
  const std::uint64_t before = allocations;
  round();
  round();
  return allocations - before;
}

std::uint64_t taken_by_drag(Deformer& solver, const Mesh& mesh, ElementId element, double radius) {
  return taken_around(radius, [&](const Point& way) { solver.move(element, mesh.rest_position(element) + way); });
}

std::uint64_t taken_by_handle(Deformer& solver, const std::vector<ElementId>& elements, double radius) {
  Handle handle(solver.body(), elements);
  return taken_around(radius, [&](const Point& way) {
    solver.move(handle, {handle.grabbed().pivot + way, Point::Zero()});
  });
}

}  // namespace

class TestAllocations : public QObject {
  Q_OBJECT

 private slots:
  void theCounterCounts() {
    const std::uint64_t before = allocations;
    ::operator delete(::operator new(5));
    QCOMPARE(allocations - before, std::uint64_t{1});
  }

  void aPassTakesNothing_data() {
    QTest::addColumn<int>("algorithm");
    QTest::addColumn<bool>("jittered");
    for (const auto& info : algorithms()) {
      QTest::addRow("%s, grid", info.name.data()) << int(info.algorithm) << false;
      if (info.algorithm != Algorithm::chainmail_3d) {
        QTest::addRow("%s, jittered", info.name.data()) << int(info.algorithm) << true;
      }
    }
  }
  void aPassTakesNothing() {
    QFETCH(int, algorithm);
    QFETCH(bool, jittered);
    const MeshPointer mesh = jittered ? jittered_triangles(24, 24, 3) : make_mesh(MeshKind::grid, {24, 24, 1});
    for (const Precision precision : precisions) {
      const auto solver = std::make_unique<Deformer>(mesh, Algorithm(algorithm), precision);
      QCOMPARE(taken_by_drag(*solver, *mesh, 12 * 24 + 12, 2), std::uint64_t{0});
      solver->body().reset();
      solver->body().set_softness({stiff, {}});
      QCOMPARE(taken_by_drag(*solver, *mesh, 0, 6), std::uint64_t{0});
    }
  }

  void aHandleOfManyTakesNothing_data() { aPassTakesNothing_data(); }
  void aHandleOfManyTakesNothing() {
    QFETCH(int, algorithm);
    QFETCH(bool, jittered);
    const MeshPointer mesh = jittered ? jittered_triangles(24, 24, 3) : make_mesh(MeshKind::grid, {24, 24, 1});
    for (const Precision precision : precisions) {
      const auto solver = std::make_unique<Deformer>(mesh, Algorithm(algorithm), precision);
      QCOMPARE(taken_by_handle(*solver, {299, 300, 301, 324}, 2), std::uint64_t{0});
    }
  }

  /// A product of a matrix and a vector needs no memory. Neo-Hookean FEM takes some in each factorization.
  void aLinearMethodTakesNothing_data() {
    QTest::addColumn<int>("algorithm");
    QTest::newRow("linear FEM") << int(Algorithm::linear_fem);
    QTest::newRow("BEM") << int(Algorithm::boundary_elements);
  }
  void aLinearMethodTakesNothing() {
    QFETCH(int, algorithm);
    const MeshPointer mesh = make_mesh(MeshKind::tetra, {5, 5, 5});
    for (const Precision precision : precisions) {
      const auto solver = std::make_unique<Deformer>(mesh, Algorithm(algorithm), precision);
      solver->body().pin(layer(*mesh, *find_side("bottom")));
      QCOMPARE(taken_by_drag(*solver, *mesh, 124, 0.5), std::uint64_t{0});
      QCOMPARE(taken_by_handle(*solver, layer(*mesh, *find_side("top")), 0.5), std::uint64_t{0});
    }
  }

  void relaxationTakesNothing_data() {
    QTest::addColumn<int>("scheme");
    QTest::newRow("mean") << int(RelaxationScheme::mean);
    QTest::newRow("link") << int(RelaxationScheme::link);
  }
  void relaxationTakesNothing() {
    QFETCH(int, scheme);
    const auto mesh = make_mesh(MeshKind::grid, {24, 24, 1});
    const auto solver = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, Precision::single_precision);
    solver->set_relaxation(RelaxationScheme(scheme));
    const ElementId element = 12 * 24 + 12;
    const auto drag_and_relax = [&](double by) {
      solver->move(element, mesh->rest_position(element) + Point(by, 0, 0));
      solver->wake(solver->moved());
      for (int sweep = 0; sweep < 5; ++sweep) {
        solver->relax_slice(1, 200, std::array{element});
      }
    };
    drag_and_relax(3);
    drag_and_relax(-3);
    const std::uint64_t before = allocations;
    drag_and_relax(3);
    drag_and_relax(-3);
    QCOMPARE(allocations - before, std::uint64_t{0});
  }
};

QTEST_APPLESS_MAIN(TestAllocations)
#include "test_allocations.moc"
