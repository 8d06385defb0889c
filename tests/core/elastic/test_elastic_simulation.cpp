#include <QtTest>

#include "core/elastic/elastic_problems.h"
#include "mesh/error.h"
#include "program.h"
#include "simulate/simulation.h"

namespace chainmail::test_elastic_simulation {

using namespace chainmail::test;

/// Methods of elasticity as algorithms of a panel: they support the same commands and the same undo.
class ElasticSimulationTest : public QObject {
  Q_OBJECT

 private slots:
  void all_are_offered();
  void a_drag_is_answered_data() { every_method(); }
  void a_drag_is_answered();
  void undo_is_exact_data() { every_method(); }
  void undo_is_exact();
  void an_updated_factor_changes_no_bit();
  void a_shape_is_kept_when_exact_takes_over();
  void without_pins_nothing_moves();
  void a_part_that_a_cut_sets_free_is_told();
  void a_change_of_algorithm_or_material_answers_at_once();
  void relaxation_leaves_a_static_answer_alone();
  void a_remark_comes_and_goes();
  void a_pass_is_given_up_data() { every_method(); }
  void a_pass_is_given_up();

 private:
  static void every_method() {
    QTest::addColumn<int>("algorithm");
    for (const AlgorithmInfo& one : elastic_algorithms()) {
      if (one.algorithm != Algorithm::boundary_elements) {  // needs a closed surface, and has its own tests
        QTest::newRow(one.name.data()) << int(one.algorithm);
      }
    }
  }
};

namespace {

struct Bar : Simulation {
  explicit Bar(Algorithm algorithm, bool is_pinned = true, Precision precision = Precision::double_precision)
      : Simulation(make_mesh(MeshKind::tetra, {5, 3, 3}), algorithm, precision) {
    if (is_pinned) {
      apply(commands::Pin{layer(mesh(), *find_side("left"))});
    }
  }

  void drag(ElementId element, const Point& target) {
    apply(commands::Grab{element});
    apply(commands::Drag{target});
    apply(commands::Release{});
  }
  std::vector<double> all() const { return positions_of(deformer(), mesh()); }
  Point at(ElementId element) const { return position_of(deformer(), mesh(), element); }
};

constexpr ElementId tip = 4;

}  // namespace

void ElasticSimulationTest::all_are_offered() {
  QCOMPARE(every_algorithm().size(), algorithms().size() + elastic_algorithms().size());
  for (const AlgorithmInfo& one : every_algorithm()) {
    QVERIFY(find_algorithm(one.name) == one.algorithm);
    QCOMPARE(info(one.algorithm).name, one.name);
  }
  for (const AlgorithmInfo& one : algorithms()) {
    QVERIFY(!info(one.algorithm).elastic);
  }
}

void ElasticSimulationTest::a_drag_is_answered() {
  QFETCH(const int, algorithm);
  for (const Precision precision : precisions) {
    Bar bar(Algorithm(algorithm), true, precision);
    const auto rest = bar.all();
    bar.drag(tip, Point(4.5, 0.5, 0.25));
    QCOMPARE(bar.at(tip), Point(4.5, 0.5, 0.25));
    QVERIFY(bar.statistics().last_pass.moved > 10);
    for (const ElementId pin : bar.body().pins()) {
      QCOMPARE(bar.at(pin), bar.mesh().rest_position(pin));
    }
    bar.apply(commands::Reset{});
    QVERIFY(same_bits(bar.all(), rest));
    QVERIFY_THROWS_EXCEPTION(Error, bar.drag(0, Point(1, 1, 1)));  // pinned
  }
}

void ElasticSimulationTest::undo_is_exact() {
  QFETCH(const int, algorithm);
  Bar bar{Algorithm(algorithm)};
  bar.drag(tip, Point(4.2, 0.3, 0));
  bar.apply(commands::KeepState{1});
  const auto kept = bar.all();
  bar.drag(44, Point(4, 3, 2));
  const auto after = bar.all();
  QVERIFY(!same_bits(after, kept));
  bar.apply(commands::RestoreState{1});
  QVERIFY(same_bits(bar.all(), kept));
  bar.drag(44, Point(4, 3, 2));
  // The same equilibrium again: Newton's method reaches it within its tolerance of 1e-9 cells.
  QVERIFY(largest_step(bar.all(), after) < 1e-8);
}

/// Linear FEM updates its factors at a cut and at its undo. A simulation in which the same links were cut from the
/// beginning answers alike, bit for bit.
void ElasticSimulationTest::an_updated_factor_changes_no_bit() {
  const std::vector<LinkId> links{40, 41, 55};
  const Point target(4.2, 0.3, 0.1);
  const auto dragged = [&](Bar& bar) {
    bar.apply(commands::Grab{{4, 9, 14}});
    bar.apply(commands::Drag{{0.1, 0.3, 0.2}, {}, true});
    bar.apply(commands::Release{});
    const std::vector<double> of_many = bar.all();
    bar.drag(tip, target);
    std::vector<double> all = bar.all();
    all.insert(all.end(), of_many.begin(), of_many.end());
    return all;
  };
  Bar cut{Algorithm::linear_fem}, whole{Algorithm::linear_fem}, bar{Algorithm::linear_fem};
  cut.apply(commands::Cut{links});
  const auto when_cut = dragged(cut), when_whole = dragged(whole);
  QVERIFY(when_cut != when_whole);
  const auto after = [&](const Command& change) {
    bar.apply(change);
    bar.apply(commands::Reset{});
    return dragged(bar);
  };
  QVERIFY(after(commands::Release{}) == when_whole);
  QVERIFY(after(commands::Cut{links}) == when_cut);
  QVERIFY(after(commands::Uncut{links}) == when_whole);
  QVERIFY(after(commands::Cut{links}) == when_cut);
}

/// Exact stores positions as displacements from rest. The change must not treat the object as being at rest.
void ElasticSimulationTest::a_shape_is_kept_when_exact_takes_over() {
  Bar bar(Algorithm::free_form, false);
  bar.apply(commands::Grab{44});
  bar.apply(commands::Drag{Point(4.2, 2.1, 2)});
  bar.apply(commands::SetPositions{std::make_shared<const Snapshot>(bar.snapshot())});  // so that no pass answers
  const auto shaped = bar.all();
  bar.apply(commands::SetAlgorithm{Algorithm::exact});
  QVERIFY(largest_step(bar.all(), shaped) < 1e-12);
}

void ElasticSimulationTest::without_pins_nothing_moves() {
  for (const Algorithm algorithm : {Algorithm::linear_fem, Algorithm::neo_hookean}) {
    Bar bar(algorithm, false);
    const auto rest = bar.all();
    bar.apply(commands::Grab{tip});
    try {
      bar.apply(commands::Drag{Point(5, 1, 0)});
      QFAIL("it has no solution");
    } catch (const Error& error) {
      QVERIFY(QString::fromStdString(error.what()).contains("nothing pins it"));
    }
    QVERIFY(same_bits(bar.all(), rest));
    QCOMPARE(bar.statistics().passes, std::uint64_t(0));
    bar.apply(commands::Pin{layer(bar.mesh(), *find_side("left"))});
    bar.apply(commands::Drag{Point(5, 1, 0)});  // once it is pinned, there is an answer
    QCOMPARE(bar.at(tip), Point(5, 1, 0));
  }
}

/// The factors of before the cut do not hide it.
void ElasticSimulationTest::a_part_that_a_cut_sets_free_is_told() {
  Bar bar(Algorithm::linear_fem);
  bar.drag(tip, Point(5, 1, 0));
  const Mesh& mesh = bar.mesh();
  const double middle = (mesh.box[0][0] + mesh.box[1][0]) / 2 + 0.25;  // between two layers
  std::vector<LinkId> across;
  for (LinkId link = 0; link < mesh.link_count(); ++link) {
    const auto [a, b] = mesh.links[link];
    if ((mesh.rest_position(a)[0] < middle) != (mesh.rest_position(b)[0] < middle)) {
      across.push_back(link);
    }
  }
  bar.apply(commands::Cut{across});
  bar.apply(commands::Grab{tip});
  try {
    bar.apply(commands::Drag{Point(5, 2, 0)});
    QFAIL("the part with the handle has no solution");
  } catch (const Error& error) {
    QVERIFY2(QString::fromStdString(error.what()).contains("hold"), error.what());
  }
}

void ElasticSimulationTest::a_change_of_algorithm_or_material_answers_at_once() {
  Bar bar(Algorithm::natural_queue), linear(Algorithm::linear_fem);
  const Point target(5, 1, 0);
  bar.drag(tip, target);
  linear.drag(tip, target);
  QVERIFY(!same_bits(bar.all(), linear.all()));
  bar.apply(commands::SetAlgorithm{Algorithm::linear_fem});
  QVERIFY(same_bits(bar.all(), linear.all()));
  ElasticOptions options;
  options.material.poisson = 0.45;
  bar.apply(commands::SetElastic{options});
  QVERIFY(largest_step(bar.all(), linear.all()) > 1e-3);
  QCOMPARE(bar.at(tip), target);
  options.material.poisson = 0.5;
  QVERIFY_THROWS_EXCEPTION(Error, bar.apply(commands::SetElastic{options}));
  QCOMPARE(bar.elastic().material.poisson, 0.45);
  Simulation other(bar.mesh_pointer(), Algorithm::linear_fem, Precision::double_precision);
  other.take(bar.hand_over(), Algorithm::linear_fem);
  QCOMPARE(other.elastic().material.poisson, 0.45);
}

void ElasticSimulationTest::relaxation_leaves_a_static_answer_alone() {
  Bar bar(Algorithm::neo_hookean);
  bar.apply(commands::SetRelaxation{true, 1, RelaxationScheme::mean});
  bar.drag(tip, Point(5, 1, 0));
  const auto answer = bar.all();
  QVERIFY(!bar.continue_relaxation());
  bar.relax(5, {});
  QVERIFY(same_bits(bar.all(), answer));
}

void ElasticSimulationTest::a_remark_comes_and_goes() {
  Bar bar(Algorithm::neo_hookean);
  bar.apply(commands::Grab{22});
  bar.apply(commands::Drag{Point(-6, 1, 1)});  // through the wall that holds it
  QVERIFY(QString::fromStdString(bar.statistics().remark).contains("last converged state"));
  bar.apply(commands::Drag{Point(2.1, 1, 1)});
  QVERIFY(bar.statistics().remark.empty());
}

void ElasticSimulationTest::a_pass_is_given_up() {
  QFETCH(const int, algorithm);
  Bar bar{Algorithm(algorithm)};
  const auto rest = bar.all();
  const Progress job = Progress::watched();
  bar.set_progress(job);
  job.cancel();
  bar.apply(commands::Grab{tip});
  const commands::Drag drag{bar.at(tip) + Point(0.1, 0.2, 0.1)};
  QVERIFY_THROWS_EXCEPTION(Cancelled, bar.apply(drag));
  QVERIFY(same_bits(bar.all(), rest));
  job.cancel(false);
  bar.apply(drag);
  QCOMPARE(bar.at(tip), drag.target);
}

CHAINMAIL_TEST(ElasticSimulationTest)

}  // namespace chainmail::test_elastic_simulation

#include "test_elastic_simulation.moc"
