#include <QTemporaryDir>
#include <QtTest>
#include <cmath>
#include <fstream>
#include <sstream>

#include "calibrate/calibrate.h"
#include "core/api/api_support.h"
#include "equilibrium/link_energy.h"
#include "measure/distance.h"
#include "measure/physical_error.h"
#include "measure/violation.h"
#include "mesh/generate.h"
#include "mesh/layers.h"
#include "program.h"

namespace chainmail::test_api_measures {

namespace {

MeshPointer inner_organ() { return generate({MeshKind::tetra, {4, 3, 3}}); }

}  // namespace

/// The public interface: measures, comparisons and calibration compute what core computes.
class ApiMeasuresTest : public QObject {
  Q_OBJECT

 private slots:
  void measures_are_those_of_core();
  void the_reference_solution_is_that_of_core();
  void bad_measures_are_refused();
  void jobs_are_cancelled();
  void methods_are_compared();
  void bad_comparisons_are_refused();
  void softness_is_calibrated();
  void bad_calibrations_are_refused();
};

void ApiMeasuresTest::measures_are_those_of_core() {
  cm::Deformer deformer(cm::make_cloth(8, 8), "generalized");
  const auto solver = std::make_unique<Deformer>(generate({MeshKind::cloth, {8, 8, 1}}), Algorithm::generalized,
                                                 chainmail::Precision::double_precision);
  deformer.body().cut({3});
  solver->body().cut(std::vector<chainmail::LinkId>{3});
  deformer.move(9, {-4, 6, 0});
  solver->move(9, Point(-4, 6, 0));
  const chainmail::Body& body = solver->body();
  const auto expected = measure_violation(body.mesh(), body.softness(), body.cuts(), body.positions());
  const cm::Violation found = cm::violation(deformer.body());
  QVERIFY(found.max > 0);
  QCOMPARE(found.max, expected.max);
  QCOMPARE(found.rms, expected.rms);
  QCOMPARE(found.fraction, expected.fraction);
  QCOMPARE(found.links, expected.links);
  QCOMPARE(cm::violation(deformer.body(), 20), link_violation(body.mesh(), body.softness(), body.positions(), 20));
  QCOMPARE(cm::displacement(deformer.body()).max, measure_displacement(body.mesh(), body.positions()).max);
  QVERIFY(deformer.body().energy() == cm::EnergyKind::material);
  for (const auto kind : {chainmail::EnergyKind::isotropic, chainmail::EnergyKind::axial,
                          chainmail::EnergyKind::corotated, chainmail::EnergyKind::material}) {
    cm::Body turned = deformer.body();
    turned.set_energy(static_cast<cm::EnergyKind>(kind));
    QVERIFY(turned.energy() == static_cast<cm::EnergyKind>(kind));
    chainmail::Softness softness = body.softness();
    set_energy(softness, kind);
    QCOMPARE(cm::elastic_energy(turned),
             chainmail::elastic_energy(body.mesh(), softness, body.cuts(), body.positions()));
  }
  const cm::Body rest(deformer.body().mesh());
  const cm::Spread apart = cm::distance(deformer.body(), rest);
  QCOMPARE(apart.max, cm::displacement(deformer.body()).max / deformer.body().mesh().mean_rest_length());
  QCOMPARE(cm::distance(deformer.body(), rest.positions()).rms, apart.rms);
}

void ApiMeasuresTest::the_reference_solution_is_that_of_core() {
  cm::Body body(organ());
  body.pin(body.mesh().side("left"));
  body.set_elasticity({.poisson = 0.2});
  std::vector<double> positions = body.mesh().rest_positions();
  const cm::ElementId tip = body.mesh().side("right").back();
  positions[3 * tip + 1] += 0.5;
  body.set_positions(positions);
  const cm::ReferenceSolution found = cm::reference_solution(body, {tip});

  const MeshPointer mesh = inner_organ();
  const auto pins = layer(*mesh, *chainmail::find_side("left"));
  chainmail::ElasticProblem problem{mesh, chainmail::Cuts(mesh), pins, std::vector<double>(3 * pins.size()), {}};
  problem.options.material.poisson = 0.2;
  const auto expected = chainmail::ReferenceSolver(problem).at(tip, mesh->rest_position(tip) + Point(0, 0.5, 0));
  QCOMPARE(found.handle_displacement(), 0.5);
  const std::vector<double> reference = found.positions();
  for (std::size_t i = 0; i < reference.size(); ++i) {
    QVERIFY(std::abs(reference[i] - mesh->rest[i] - expected.displacements[i]) < 1e-12);
  }
  // Only the handle has moved so far.
  QVERIFY(std::abs(cm::physical_error(body, found).relative - cm::physical_error_of_rest(found).relative) < 1e-12);
  QVERIFY(cm::physical_error_of_rest(found).relative > 0.5);
  body.set_positions(reference);
  QVERIFY(cm::physical_error(body, found).max < 1e-12);
}

void ApiMeasuresTest::bad_measures_are_refused() {
  cm::Body body(organ());
  const cm::Body other(organ());
  QVERIFY(has(refusal_of([&] { (void)cm::violation(body, 100'000); }), "link 100000"));
  QVERIFY(has(refusal_of([&] { cm::distance(body, other); }), "different meshes"));
  QVERIFY(has(refusal_of([&] { cm::distance(body, std::vector<double>(3)); }), "there are 3 numbers"));
  body.pin(body.mesh().side("left"));
  QVERIFY(has(refusal_of([&] { cm::reference_solution(body, {1}); }), "it is at rest"));
  QVERIFY(has(refusal_of([&] { cm::reference_solution(body, {0}); }), "pinned"));
  QVERIFY(has(refusal_of([&] { cm::reference_solution(body, {99}); }), "element 99"));
  std::vector<double> positions = body.mesh().rest_positions();
  positions[3] += 0.1;
  body.set_positions(positions);
  const auto reference = cm::reference_solution(body, {1});
  QVERIFY(has(refusal_of([&] { cm::physical_error(other, reference); }), "another mesh"));
  body.unpin(body.mesh().side("left"));
  QVERIFY(has(refusal_of([&] { cm::reference_solution(body, {1}); }), "nothing pins"));
}

void ApiMeasuresTest::jobs_are_cancelled() {
  const cm::Job job;
  cm::Deformer deformer(organ(), "neo-hookean");
  deformer.body().pin(deformer.body().mesh().side("left"));
  deformer.set_job(job);
  deformer.move(3, {3.2, 0, 0});
  QVERIFY(!job.is_cancelled() && job.share() > 0);
  const State before(deformer.body());
  job.cancel();
  QVERIFY(job.is_cancelled());
  QVERIFY_EXCEPTION_THROWN(deformer.move(3, {3.6, 0.5, 0}), cm::Cancelled);
  QVERIFY(State(deformer.body()) == before);
  QVERIFY_EXCEPTION_THROWN(cm::compare(cm::Body(cm::make_grid(4, 4)), {}, {.repetitions = 1}, job), cm::Cancelled);
  QVERIFY_EXCEPTION_THROWN(cm::calibrate(deformer.body(), {}, job), cm::Cancelled);
  QVERIFY_EXCEPTION_THROWN(cm::reference_solution(deformer.body(), {3}, job), cm::Cancelled);
}

void ApiMeasuresTest::methods_are_compared() {
  cm::Body body(cm::make_cloth(8, 8));
  body.cut({5});
  body.set_softness({.compression = 0.9, .stretch = 1.1, .shear = 0});
  body.set_softness({50, 51}, {.compression = 0.5, .stretch = 3, .shear = 1});
  const cm::Drag drag{.name = "pull <b>", .elements = {0}, .path = {{{-1, 0, 0}, {}}, {{-4, -2, 0}, {}}}};
  cm::CompareOptions options;
  options.title = "my sheet";
  options.methods = {"generalized", "exact", "3d"};
  options.sweeps = {0, 2};
  options.repetitions = 1;
  options.precision = cm::Precision::double_precision;
  const cm::Job job;
  const cm::Comparison comparison = cm::compare(body, {drag}, options, job);
  QCOMPARE(job.share(), 1.0);
  const auto& rows = comparison.rows();
  QCOMPARE(rows.size(), std::size_t(6));
  QCOMPARE(rows[0].method, std::string("generalized"));
  QCOMPARE(rows[1].label, std::string("Generalized ChainMail, 2 sweeps"));
  QVERIFY(rows[0].refusal.empty() && rows[0].ms_per_move.value() > 0 && rows[0].to_exact->max > 0);
  QVERIFY(rows[0].ms_per_move == rows[0].lower_quartile);  // of one repetition
  QCOMPARE(rows[2].to_exact->max, 0.0);
  QCOMPARE(rows[2].violation->fraction, 0.0);
  QVERIFY(has(rows[4].refusal, "only on grids") && !rows[4].ms_per_move);

  // The drag is the one that a Deformer does.
  cm::Deformer deformer(body, "generalized");
  cm::Handle handle = deformer.grab(drag.elements);
  for (const cm::Motion& motion : drag.path) {
    deformer.move(handle, handle.after(motion));
  }
  QCOMPARE(rows[0].violation->max, cm::violation(deformer.body()).max);

  QVERIFY(has(comparison.text(), "my sheet") && has(comparison.text(), "Generalized ChainMail"));
  QVERIFY(has(comparison.html(), "<!DOCTYPE html>") && has(comparison.html(), "my sheet") &&
          !has(comparison.html(), "pull <b>"));
  QVERIFY(has(comparison.json(), "\"algorithm\": \"generalized\""));
  QVERIFY(has(comparison.csv(), ",generalized,2,"));
  const QTemporaryDir folder;
  const std::filesystem::path path = folder.filePath("a/report").toStdString();
  comparison.write(path);
  std::ifstream csv(path / "report.csv");
  std::ostringstream written;
  written << csv.rdbuf();
  QCOMPARE(written.str(), comparison.csv());
  QVERIFY(std::filesystem::exists(path / "report.html") && std::filesystem::exists(path / "report.json"));
  QVERIFY(has(refusal_of([&] { comparison.write(path / "report.csv" / "below"); }), "cannot be created"));
  QCOMPARE(cm::compare(body, {}, {.methods = {"exact"}, .repetitions = 1}).rows().size(), std::size_t(3));
}

void ApiMeasuresTest::bad_comparisons_are_refused() {
  cm::Body body(cm::make_grid(4, 4));
  body.pin({15});
  const cm::Drag drag{.name = "drag", .elements = {0}, .path = {{{-1, 0, 0}, {}}}};
  const auto refused = [&](const std::vector<cm::Drag>& drags, const cm::CompareOptions& options,
                           const std::string& reason) {
    const std::string refusal = refusal_of([&] { cm::compare(body, drags, options); });
    QVERIFY2(has(refusal, reason), refusal.c_str());
  };
  refused({drag}, {.methods = {"magic"}}, "there is no such method");
  refused({drag}, {.methods = {"exact", "exact"}}, "given twice");
  refused({drag}, {.sweeps = {-1}}, "relax");
  refused({drag}, {.scheme = cm::RelaxationScheme::equilibrium}, "relaxation");
  refused({drag}, {.relax_step = no_number}, "relax-step");
  refused({drag}, {.repetitions = 0}, "repetitions");
  refused({drag}, {.seconds = no_number}, "seconds");
  refused({{"empty", {0}, {}}}, {}, "its path is empty");
  refused({{"none", {}, {{{1, 0, 0}, {}}}}}, {}, "it has no elements");
  refused({{"far", {99}, {{{1, 0, 0}, {}}}}}, {}, "element 99");
  refused({{"pinned", {15}, {{{1, 0, 0}, {}}}}}, {}, "pinned");
  refused({{"nan", {0}, {{{no_number, 0, 0}, {}}}}}, {}, "not a finite number");
  refused({{"off", {0}, {{{0, 0, 1}, {}}}}}, {}, "does not extend along z");
  refused({{"turn", {0, 1}, {{{}, {{1, 0, 0}, 5}}}}}, {}, "leave the space");
  refused({{"many", {0, 1}, {{{1, 0, 0}, {}}}}}, {.against = cm::Reference::physics}, "it grabs many elements");
  body.cut({0});
  refused({drag}, {.against = cm::Reference::physics}, "without cuts");
  body.uncut({0});
  body.unpin({15});
  refused({drag}, {.against = cm::Reference::physics}, "nothing pins it");
}

void ApiMeasuresTest::softness_is_calibrated() {
  const MeshPointer mesh = generate({MeshKind::cloth, {5, 5, 1}});
  cm::Body body(cm::make_cloth(5, 5));
  body.pin(body.mesh().side("top"));
  body.set_elasticity({.poisson = 0.4});
  const cm::CalibrateOptions options{.seed = 3, .drags = 2, .held_out = 1, .evaluations = 20, .most_sweeps = 3};
  const State before(body);
  const cm::Calibration found = cm::calibrate(body, options);
  QVERIFY(State(body) == before);

  chainmail::CalibrationOptions how;
  how.pins = layer(*mesh, *chainmail::find_side("top"));
  how.elastic.material.poisson = 0.4;
  how.seed = 3;
  how.drags = 2;
  how.held_out = 1;
  how.evaluations = 20;
  how.max_sweeps = 3;
  const auto expected = calibrate(mesh, chainmail::Cuts(mesh), how);
  const chainmail::CalibrationOptions usual;
  const cm::CalibrateOptions ours;
  QVERIFY(ours.seed == usual.seed && ours.drags == usual.drags && ours.held_out == usual.held_out &&
          ours.evaluations == usual.evaluations && ours.most_sweeps == usual.max_sweeps &&
          ours.method == cm::methods()[std::size_t(usual.algorithm)].name);
  QCOMPARE(found.softness.compression, expected.softness.compression);
  QCOMPARE(found.softness.stretch, expected.softness.stretch);
  QCOMPARE(found.softness.shear, expected.softness.shear);
  QCOMPARE(found.sweeps, expected.sweeps);
  QCOMPARE(found.evaluations, expected.evaluations);
  QCOMPARE(found.fitted.after.relative, expected.fitted.after.relative);
  QCOMPARE(found.held_out.before.rms, expected.held_out.before.rms);
  QVERIFY(has(found.json, "held_out"));

  const QTemporaryDir folder;
  const std::filesystem::path path = folder.filePath("felt.json").toStdString();
  cm::write_preset(path, "felt", found.softness);
  std::ifstream preset(path);
  std::ostringstream written;
  written << preset.rdbuf();
  QVERIFY(has(written.str(), "\"felt\"") && has(written.str(), "\"compression\""));
}

void ApiMeasuresTest::bad_calibrations_are_refused() {
  cm::Body body(cm::make_cloth(5, 5));
  QVERIFY(has(refusal_of([&] { cm::calibrate(body); }), "nothing pins"));
  body.pin(body.mesh().side("top"));
  QVERIFY(has(refusal_of([&] { cm::calibrate(body, {.method = "magic"}); }), "there is no such method"));
  QVERIFY(has(refusal_of([&] { cm::calibrate(body, {.method = "fem"}); }), "no softness"));
  QVERIFY(has(refusal_of([&] { cm::calibrate(body, {.drags = 0}); }), "drags"));
  QVERIFY(has(refusal_of([&] { cm::calibrate(body, {.held_out = 0}); }), "held_out"));
  QVERIFY(has(refusal_of([&] { cm::calibrate(body, {.evaluations = 0}); }), "evaluations"));
  QVERIFY(has(refusal_of([&] { cm::calibrate(body, {.most_sweeps = -1}); }), "most_sweeps"));
  const QTemporaryDir folder;
  const std::filesystem::path path = folder.filePath("preset.json").toStdString();
  QVERIFY(!refusal_of([&] { cm::write_preset(path, "", {}); }).empty());
  QVERIFY(!refusal_of([&] { cm::write_preset(path, "felt", {.compression = 2}); }).empty());
  QVERIFY(!std::filesystem::exists(path));
}

CHAINMAIL_TEST(ApiMeasuresTest)

}  // namespace chainmail::test_api_measures

#include "test_api_measures.moc"
