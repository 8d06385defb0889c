#include <QtTest>
#include <numeric>
#include <set>

#include "calibrate/calibrate.h"
#include "calibrate/drags.h"
#include "calibrate/optimum.h"
#include "core/support.h"
#include "measure/physical_error.h"
#include "mesh/error.h"
#include "mesh/layers.h"
#include "program.h"
#include "simulate/simulation.h"

namespace chainmail::test_calibrate {

using chainmail::test::make_mesh;

/// Calibration: the search, and its result on a tiny sheet.
class CalibrateTest : public QObject {
  Q_OBJECT

 private slots:
  void an_optimum_is_found_within_its_bounds_data();
  void an_optimum_is_found_within_its_bounds();
  void what_is_thrown_comes_through();
  void drags_are_those_of_a_hand_data();
  void drags_are_those_of_a_hand();
  void each_drag_has_its_reference_solution();
  void the_residuals_are_those_of_the_result();
  void it_comes_closer();
  void the_equilibrium_comes_closer();
  void the_equilibrium_is_that_of_the_object();
  void drags_held_out_are_others();
  void drags_without_a_reference_are_given_up();
  void it_is_the_same_each_time();
  void it_tells_its_progress_and_is_cancelled();
  void what_makes_no_sense_is_refused();
};

namespace {

const MeshPointer sheet = make_mesh(MeshKind::cloth, {5, 5, 1});

CalibrationOptions quick() {
  CalibrationOptions options;
  options.scheme = RelaxationScheme::mean;
  options.pins = layer(*sheet, *find_side("top"));
  options.drags = 2;
  options.evaluations = 40;
  return options;
}

CalibrationResult found(const CalibrationOptions& options) { return calibrate(sheet, Cuts(sheet), options); }

}  // namespace

void CalibrateTest::an_optimum_is_found_within_its_bounds_data() {
  QTest::addColumn<Search>("search");
  QTest::addColumn<double>("x");
  QTest::addColumn<double>("y");
  for (const Search search : {Search::everywhere, Search::about_a_point}) {
    const char* name = search == Search::everywhere ? "everywhere" : "about a point";
    QTest::addRow("%s, inside", name) << search << 0.3 << 2.5;
    QTest::addRow("%s, beyond a corner", name) << search << -1.0 << 9.0;
  }
}

void CalibrateTest::an_optimum_is_found_within_its_bounds() {
  QFETCH(Search, search);
  QFETCH(double, x);
  QFETCH(double, y);
  int asked = 0;
  const Optimum optimum = find_optimum(search, {0, 1}, {1, 3}, {1, 1}, 200, [&](const std::vector<double>& at) {
    ++asked;
    [&] { QVERIFY(at[0] >= 0 && at[0] <= 1 && at[1] >= 1 && at[1] <= 3); }();
    return std::abs(at[0] - x) + std::abs(at[1] - y);  // not differentiable at its minimum
  });
  QVERIFY(asked <= 200);
  // A hundredth of the ranges: 200 evaluations reach this easily, while a grid of 200 points would not.
  QVERIFY(std::abs(optimum.at[0] - std::clamp(x, 0.0, 1.0)) < 0.01);
  QVERIFY(std::abs(optimum.at[1] - std::clamp(y, 1.0, 3.0)) < 0.02);
}

void CalibrateTest::what_is_thrown_comes_through() {
  int asked = 0;
  const auto fails = [&](const std::vector<double>&) -> double {
    ++asked;
    throw Cancelled();
  };
  QVERIFY_EXCEPTION_THROWN(find_optimum(Search::everywhere, {0, 0}, {1, 1}, {0, 0}, 100, fails), Cancelled);
  QCOMPARE(asked, 1);
}

void CalibrateTest::drags_are_those_of_a_hand_data() {
  QTest::addColumn<MeshPointer>("mesh");
  QTest::newRow("small sheet") << make_mesh(MeshKind::cloth, {9, 5, 1}, {}, 0.1);
  QTest::newRow("large solid") << make_mesh(MeshKind::tetra, {6, 5, 5}, {}, 3);
}

/// Each drag has a length of 5 to 20 % of the object's size and equal steps. Its element is on the surface and not next
/// to the pins.
void CalibrateTest::drags_are_those_of_a_hand() {
  QFETCH(MeshPointer, mesh);
  CalibrationOptions options;
  options.pins = layer(*mesh, *find_side("left"));
  options.drags = 12;
  const double size = (mesh->box[1] - mesh->box[0]).maxCoeff();
  const auto from_pins = [&](ElementId e) { return mesh->rest_position(e).x() - mesh->box[0].x(); };
  const auto outside = boundary(*mesh);
  for (const ReferenceDrag& drag : reference_drags(mesh, Cuts(mesh), options, {}).fitted) {
    const Point start = mesh->rest_position(drag.element);
    const double length = (drag.target - start).norm();
    QVERIFY(length >= 0.05 * size && length <= 0.2 * size);
    QVERIFY(from_pins(drag.element) >= size / 4);
    QVERIFY(mesh->space_dimension == 2 || std::ranges::binary_search(outside, drag.element));
    QVERIFY(std::get<commands::Grab>(drag.moves.commands.front()).elements.front() == drag.element);
    Point at = start;
    const auto steps = double(drag.moves.commands.size() - 1);
    for (std::size_t i = 1; i < drag.moves.commands.size(); ++i) {
      const Point next = std::get<commands::Drag>(drag.moves.commands[i]).target;
      QVERIFY((next - at - (drag.target - start) / steps).norm() < 1e-12 * size);
      at = next;
    }
    QVERIFY((at - drag.target).norm() < 1e-12 * size);
  }
}

namespace {

/// A sheet that is cut from the bottom to its middle, with a material other than the default.
CalibrationOptions cut_sheet(Cuts& cuts) {
  for (const auto& [a, b] : {std::pair(2U, 3U), {7U, 8U}}) {
    cuts.cut(*find_link(*sheet, a, b));
  }
  CalibrationOptions options = quick();
  options.elastic.material = {2, 0.45};
  options.drags = 3;
  return options;
}

}  // namespace

void CalibrateTest::each_drag_has_its_reference_solution() {
  Cuts cuts(sheet);
  const CalibrationOptions options = cut_sheet(cuts);
  ReferenceSolver solver({sheet, cuts, options.pins, std::vector<double>(2 * options.pins.size()), options.elastic});
  for (const ReferenceDrag& drag : reference_drags(sheet, cuts, options, {}).fitted) {
    const ReferenceSolution expected = solver.at(drag.element, drag.target);
    QCOMPARE(drag.reference.handle_displacement, expected.handle_displacement);
    QVERIFY(chainmail::test::largest_step(drag.reference.displacements, expected.displacements) < 1e-8);
  }
}

/// Runs the drags again, with the softness, the number of sweeps and the scheme of the result.
void CalibrateTest::the_residuals_are_those_of_the_result() {
  for (const RelaxationScheme scheme : {RelaxationScheme::mean, RelaxationScheme::link}) {
    Cuts cuts(sheet);
    CalibrationOptions options = cut_sheet(cuts);
    options.scheme = scheme;
    const CalibrationResult result = calibrate(sheet, cuts, options);
    QVERIFY(result.sweeps > 0);
    const auto residual = [&](const ReferenceDrag& drag, const LinkSoftness& softness, int sweeps) {
      Simulation simulation(sheet, options.algorithm, Precision::double_precision);
      simulation.apply(commands::SetSoftness{{softness, {}}});
      simulation.apply(commands::Cut{cuts.links()});
      simulation.apply(commands::Pin{options.pins});
      simulation.apply(commands::SetRelaxation{false, 1, scheme});
      simulation.apply(commands::Reset{});
      for (const Command& command : drag.moves.commands) {
        simulation.apply(command);
        if (std::holds_alternative<commands::Drag>(command)) {
          simulation.relax(sweeps, {1, simulation.relaxation().scheme});
        }
      }
      return measure_physical_error(*sheet, simulation.body().positions(), drag.reference);
    };
    const auto drags = reference_drags(sheet, cuts, options, {}).fitted;
    for (std::size_t i = 0; i < drags.size(); ++i) {
      const auto before = residual(drags[i], {}, 0), after = residual(drags[i], result.softness, result.sweeps);
      QVERIFY(std::abs(result.fitted.drags[i].before.rms - before.rms) < 1e-12);
      QVERIFY(std::abs(result.fitted.drags[i].before.max - before.max) < 1e-12);
      QVERIFY(std::abs(result.fitted.drags[i].after.rms - after.rms) < 1e-12);
      QVERIFY(std::abs(result.fitted.drags[i].after.max - after.max) < 1e-12);
    }
  }
}

void CalibrateTest::it_comes_closer() {
  for (const Algorithm algorithm : {Algorithm::exact, Algorithm::natural_queue}) {
    CalibrationOptions options = quick();
    options.algorithm = algorithm;
    const CalibrationResult result = found(options);
    QVERIFY(result.fitted.after.relative > 0 && result.fitted.after.relative < 0.9 * result.fitted.before.relative);
    QVERIFY(result.fitted.after.relative < result.fitted.nothing.relative);
    QCOMPARE(result.evaluations, 40);
    const auto& [compression, stretch, shear, lateral, stiffness, exponent] = result.softness;
    QVERIFY(compression >= 0 && compression <= 1 && stretch >= 1 && stretch <= 3 && shear >= 0 && shear <= 2);
    QCOMPARE(result.fitted.drags.size(), std::size_t{2});
    QCOMPARE(result.held_out.drags.size(), std::size_t{4});
    for (const TestedDrags& tested : {result.fitted, result.held_out}) {
      const double count = double(tested.drags.size());
      Residual before, after, nothing;
      const auto add = [&](Residual& sum, const Residual& one) {
        sum.rms += one.rms / count;
        sum.relative += one.relative / count;
        sum.max = std::max(sum.max, one.max);
      };
      for (const CalibrationDrag& drag : tested.drags) {
        add(before, drag.before);
        add(after, drag.after);
        add(nothing, drag.nothing);
      }
      for (const auto& [expected, told] :
           {std::pair{before, tested.before}, {after, tested.after}, {nothing, tested.nothing}}) {
        QVERIFY(std::abs(expected.rms - told.rms) < 1e-14 && std::abs(expected.relative - told.relative) < 1e-14);
        QCOMPARE(told.max, expected.max);
      }
    }
  }
}

/// Its lateral stiffness and exponent are found too, and its residuals are those of an equilibrium.
void CalibrateTest::the_equilibrium_comes_closer() {
  CalibrationOptions options = quick();
  options.algorithm = Algorithm::exact;
  const CalibrationResult sweeps = found(options);
  options.scheme = RelaxationScheme::equilibrium;
  options.evaluations = 120;
  for (const EnergyKind energy : {EnergyKind::corotated, EnergyKind::isotropic}) {
    options.energy = energy;
    const CalibrationResult result = found(options);
    QCOMPARE(result.sweeps, 0);
    QVERIFY(result.evaluations <= 120);
    const LinkSoftness usual;
    const bool varies = result.softness.exponent != usual.exponent && result.softness.lateral != info(energy).lateral;
    QCOMPARE(varies, energy != EnergyKind::isotropic);
    if (energy != EnergyKind::isotropic) {
      QVERIFY(result.fitted.after.relative < sweeps.fitted.after.relative);
      QVERIFY(result.held_out.after.relative < 0.5 * result.held_out.nothing.relative);
    }
    ReferenceSolver reference({sheet, Cuts(sheet), options.pins, std::vector<double>(2 * options.pins.size(), 0), {}});
    const CalibrationDrag& drag = result.held_out.drags.front();
    Simulation simulation(sheet, options.algorithm, Precision::double_precision);
    simulation.apply(commands::Pin{options.pins});
    simulation.apply(commands::SetSoftness{Softness{result.softness, {}, energy}});
    simulation.apply(commands::Grab{{drag.element}});
    simulation.apply(commands::Drag{drag.target});
    simulation.apply(commands::Relax{1000, 1, RelaxationScheme::equilibrium, 1e-6});
    const PhysicalError error =
        measure_physical_error(*sheet, simulation.body().positions(), reference.at(drag.element, drag.target));
    QVERIFY(std::abs(error.relative - drag.after.relative) < 0.03);
  }
}

/// Where no region binds, the equilibrium of the object's own material and cuts is the reference solution.
void CalibrateTest::the_equilibrium_is_that_of_the_object() {
  Cuts cuts(sheet);
  CalibrationOptions options = cut_sheet(cuts);
  options.scheme = RelaxationScheme::equilibrium;
  options.energy = EnergyKind::material;
  options.elastic.law = options.law = {StrainLaw::Kind::gent, 0.5};
  options.evaluations = 200;
  const Residual found = calibrate(sheet, cuts, options).fitted.after;
  QVERIFY2(found.relative < 0.02, qPrintable(QString::number(found.relative)));
}

void CalibrateTest::drags_held_out_are_others() {
  CalibrationOptions options = quick();
  options.evaluations = 1;
  options.not_these = {0, 1, 2, 3, 4};
  std::set<ElementId> fitted, held_out;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    options.seed = seed;
    fitted.clear();
    held_out.clear();
    const CalibrationResult result = found(options);
    for (const CalibrationDrag& drag : result.fitted.drags) {
      fitted.insert(drag.element);
    }
    for (const CalibrationDrag& drag : result.held_out.drags) {
      held_out.insert(drag.element);
    }
    for (const ElementId element : held_out) {
      QVERIFY(!fitted.contains(element) && element > 4);
    }
    QVERIFY(std::ranges::all_of(fitted, [](ElementId element) { return element > 4; }));
  }
}

/// Only one element is free, and each drag would take it beyond its pinned neighbours, which inverts cells.
void CalibrateTest::drags_without_a_reference_are_given_up() {
  const MeshPointer large = make_mesh(MeshKind::cloth, {31, 31, 1});
  CalibrationOptions options;
  options.pins.resize(large->element_count());
  std::iota(options.pins.begin(), options.pins.end(), ElementId{0});
  std::erase(options.pins, large->element_count() / 2);
  options.drags = 2;
  try {
    reference_drags(large, Cuts(large), options, {});
    QFAIL("it has references");
  } catch (const Error& error) {
    QVERIFY2(QString(error.what()).startsWith("reference solution: too many of the drags do not converge: "),
             error.what());
  }
}

void CalibrateTest::it_is_the_same_each_time() {
  const CalibrationResult first = found(quick());
  QVERIFY(found(quick()) == first);
  CalibrationOptions other = quick();
  other.seed = 2;
  const CalibrationResult second = found(other);
  QVERIFY(second.fitted.drags[0].target != first.fitted.drags[0].target);
  // Pins in another order or given twice are the same pins.
  CalibrationOptions same = quick();
  std::ranges::reverse(same.pins);
  same.pins.push_back(same.pins.front());
  QVERIFY(found(same) == first);
}

void CalibrateTest::it_tells_its_progress_and_is_cancelled() {
  const Progress job = Progress::watched();
  calibrate(sheet, Cuts(sheet), quick(), job);
  QCOMPARE(job.share(), 1.0);
  job.cancel();
  QVERIFY_EXCEPTION_THROWN(calibrate(sheet, Cuts(sheet), quick(), job), Cancelled);
}

void CalibrateTest::what_makes_no_sense_is_refused() {
  const auto refused = [](const char* where, auto change) {
    CalibrationOptions options = quick();
    change(options);
    try {
      found(options);
    } catch (const Error& error) {
      return QString::fromStdString(error.where()) == where;
    }
    return false;
  };
  QVERIFY(refused("pins", [](auto& options) { options.pins = {}; }));
  QVERIFY(refused("pins", [](auto& options) { options.pins = {0, 25}; }));
  QVERIFY(refused("pins", [](auto& options) {
    for (ElementId e = 0; e < 25; ++e) {
      options.pins.push_back(e);
    }
  }));
  QVERIFY(refused("poisson", [](auto& options) { options.elastic.material.poisson = 0.5; }));
  QVERIFY(refused("young", [](auto& options) { options.elastic.material.young = 0; }));
  QVERIFY(refused("drags", [](auto& options) { options.drags = 0; }));
  QVERIFY(refused("evaluations", [](auto& options) { options.evaluations = 0; }));
  QVERIFY(refused("held_out", [](auto& options) { options.held_out = -1; }));
  QVERIFY(refused("most_sweeps", [](auto& options) { options.max_sweeps = -1; }));
  QVERIFY(refused("algorithm", [](auto& options) { options.algorithm = Algorithm::linear_fem; }));
}

CHAINMAIL_TEST(CalibrateTest)

}  // namespace chainmail::test_calibrate

#include "test_calibrate.moc"
