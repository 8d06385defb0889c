#include <QtTest>

#include "core/simulations.h"
#include "mesh/error.h"
#include "mesh/layers.h"
#include "program.h"
#include "simulate/deformation.h"

namespace chainmail::test_deformation {

using namespace chainmail::test;

/// A deformation moves as a solver does, and notes what each of its passes did.
class DeformationTest : public QObject {
  Q_OBJECT

 private slots:
  void a_move_has_equal_steps();
  void passes_are_noted();
  void a_handle_of_many_goes_on_from_where_it_is();
  void commands_are_carried_out();
  void coordinates_out_of_range_are_refused();
};

void DeformationTest::a_move_has_equal_steps() {
  const MeshPointer mesh = make_mesh(MeshKind::tetra, {4, 3, 3});
  const auto pins = layer(*mesh, *find_side("left"));
  for (const Algorithm algorithm : {Algorithm::natural_queue, Algorithm::exact, Algorithm::linear_fem}) {
    int ended = 0;
    Deformation deformation(mesh, algorithm, Precision::double_precision, {.on_end = [&] { ++ended; }});
    const auto solver = std::make_unique<Deformer>(mesh, algorithm, Precision::double_precision);
    const LinkId cut = mesh->entry_link[mesh->first_entry[mesh->element_count() / 2]];
    const Softness softness{{0.9, 1.1, 0.3}, {}};
    ElasticOptions elastic;
    elastic.material.poisson = 0.4;
    deformation.apply(commands::Pin{pins});
    deformation.apply(commands::Cut{{cut}});
    deformation.apply(commands::SetSoftness{softness});
    deformation.apply(commands::SetElastic{elastic});
    solver->pin(pins);
    solver->cut(std::array{cut});
    solver->body().set_softness(softness);
    solver->body().set_elastic(elastic);
    const ElementId tip = layer(*mesh, *find_side("right")).back();
    const Point start = mesh->rest_position(tip), target = start + Point(0.5, 1, -0.25);
    deformation.move(tip, target, 4);
    for (const double share : {0.25, 0.5, 0.75, 1.0}) {
      solver->move(tip, start + share * (target - start));
    }
    QCOMPARE(ended, 4);
    QVERIFY(same_bits(positions_of(deformation.simulation()), positions_of(*solver, *mesh)));
  }
}

void DeformationTest::passes_are_noted() {
  const MeshPointer mesh = make_mesh(MeshKind::grid, {6, 5, 1});
  Deformation deformation(mesh, Algorithm::exact, Precision::double_precision, {.relax = 3, .traced = true});
  deformation.apply(commands::Pin{{0}});
  deformation.apply(commands::SetRelaxation{false, 1, RelaxationScheme::equilibrium});
  deformation.move(29, {5.5, 4.5, 0}, 1);
  deformation.move(29, {50, 4.5, 0}, 1);  // the pin stops it
  const DeformSummary summary = deformation.summary();
  QCOMPARE(summary.passes.size(), std::size_t(2));
  QVERIFY(!summary.passes[0].stopped_at && summary.passes[1].stopped_at.value().x() < 50);
  QVERIFY(summary.passes[1].handle == std::vector<ElementId>{29} && summary.passes[1].target == Point(50, 4.5, 0));
  QVERIFY(summary.algorithm == Algorithm::exact && summary.elements == 30 && summary.links == 49 &&
          summary.equilibrium);
  Deformer deformer(mesh, Algorithm::exact);
  deformer.pin(std::array{ElementId{0}});
  Trace trace;
  deformer.move(29, {5.5, 4.5, 0}, &trace);
  QVERIFY(deformation.traces().size() == 2 && !trace.empty() && deformation.traces()[0].size() == trace.size());
}

void DeformationTest::a_handle_of_many_goes_on_from_where_it_is() {
  Deformation deformation(make_mesh(MeshKind::grid, {6, 5, 1}), Algorithm::natural_queue, Precision::double_precision,
                          {});
  QVERIFY_EXCEPTION_THROWN(deformation.move_handle(Point(1, 0, 0), {}, 1), Error);
  deformation.apply(commands::Grab{std::vector<ElementId>{28, 29}});
  deformation.move_handle(Point(1, 0, 0), {Point(0, 0, 1), 30}, 2);
  deformation.move_handle(Point(1, 0, 0), {Point(0, 0, 1), 60}, 1);
  QVERIFY((position_of(deformation.simulation(), 28) - Point(6.5, 3.5, 0)).norm() < 1e-12);
  QCOMPARE(deformation.summary().passes.size(), std::size_t(3));
  QCOMPARE(deformation.summary().passes[2].rotation.degrees, 90.0);
  deformation.apply(commands::Drag{{5, 6, 0}});
  deformation.move_handle(Point(0, 1, 0), {}, 1);
  QCOMPARE(deformation.summary().passes[4].target, Point(5, 7, 0));
  QVERIFY_EXCEPTION_THROWN(deformation.apply(commands::Pin{{29}}), Error);
  deformation.apply(commands::Release{});
  deformation.apply(commands::Pin{{29}});
  QVERIFY_EXCEPTION_THROWN(deformation.move(29, {1, 1, 0}, 1), Error);
}

void DeformationTest::commands_are_carried_out() {
  const MeshPointer mesh = make_mesh(MeshKind::grid, {6, 5, 1});
  Deformation recorded(mesh, Algorithm::generalized, Precision::double_precision, {});
  Deformation called(mesh, Algorithm::generalized, Precision::double_precision, {});
  for (const Command& command : std::vector<Command>{
           commands::Grab{29}, commands::Drag{{6, 5, 0}}, commands::Drag{{7, 6, 0}}, commands::Release{},
           commands::Grab{std::vector<ElementId>{3, 4}}, commands::Drag{{0, -2, 0}, {}, true}}) {
    recorded.apply(command);
  }
  called.move(29, {6, 5, 0}, 1);
  called.move(29, {7, 6, 0}, 1);
  called.apply(commands::Grab{std::vector<ElementId>{3, 4}});
  called.move_handle(Point(0, -2, 0), {}, 1);
  QVERIFY(same_bits(positions_of(recorded.simulation()), positions_of(called.simulation())));
  QCOMPARE(recorded.summary().passes.size(), std::size_t(3));
}

void DeformationTest::coordinates_out_of_range_are_refused() {
  const MeshPointer far = make_mesh(MeshKind::line, {3, 1, 1}, {}, 1e38);
  check(Precision::double_precision, *far);
  QVERIFY_EXCEPTION_THROWN(check(Precision::single_precision, *far), Error);
}

CHAINMAIL_TEST(DeformationTest)

}  // namespace chainmail::test_deformation

#include "test_deformation.moc"
