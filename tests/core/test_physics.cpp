#include <Eigen/Geometry>
#include <QXmlStreamReader>
#include <QtTest>
#include <map>
#include <set>
#include <sstream>

#include "core/comparisons.h"
#include "mesh/error.h"
#include "report/physics_cases.h"
#include "report/physics_report.h"

using namespace chainmail;
using namespace chainmail::report;
using chainmail::report::test::drag;
using chainmail::test::make_mesh;

/// The comparison with physics: the metric, who takes part, and how it is written.
class PhysicsTest : public QObject {
  Q_OBJECT

 private slots:
  void errors_by_hand();
  void the_reference_solution_knows_nothing_of_the_last_one();
  void everyone_takes_part();
  void the_truth_has_no_error_and_linear_elasticity_less_for_less();
  void drags_are_what_they_say();
  void what_has_no_answer_is_refused_by_name();
  void objects_grow();
  void it_stops_at_once();
  void the_page_is_well_formed_and_says_all();
  void csv_and_text_have_a_row_for_each();
};

namespace {

PhysicsOptions quick(std::vector<Algorithm> algorithms, std::vector<int> sweeps) {
  PhysicsOptions options;
  options.contest = report::test::quick(std::move(algorithms), std::move(sweeps));
  options.contest.repetitions = 1;
  options.growth_seconds = 0;
  return options;
}

/// All of it on a tiny bar and a tiny sheet, once for all tests that look at it.
const PhysicsReport& everything() {
  static const PhysicsReport report = [] {
    PhysicsOptions options = quick({}, {0, 1, 10});
    options.growth_seconds = 0.002;
    return compare_with_physics({pinned_bar(24, {}, {}), pinned_sheet(25, {}, {})}, options);
  }();
  return report;
}

/// The errors of contestants at the end of a drag.
std::map<std::pair<Algorithm, int>, PhysicalError> errors_of(const PhysicsDrag& drag) {
  std::map<std::pair<Algorithm, int>, PhysicalError> errors;
  for (const PhysicsEntry& entry : drag.entries) {
    if (entry.measurement) {
      errors[{entry.contestant.algorithm, entry.contestant.sweeps}] = entry.measurement->error;
    }
  }
  return errors;
}

Origin origin() { return {{"a processor", 2, "a compiler", "Release"}, "chainmail compare", "today", "v"}; }

// What Newton's method leaves, over the hand's displacement.
constexpr double converged = 1e-6;

}  // namespace

void PhysicsTest::errors_by_hand() {
  // The handle, element 0, moved by 2; the reference solution displaces 1 by 1, 2 by 0.01 and 3 not at all.
  const auto line = make_mesh(MeshKind::line, {4, 1, 1});
  const Truth truth{{-2, -1, -0.01, 0}, 2};
  const std::vector<double> at{-2, 0.4, 1.99, 3};
  const PhysicalError error =
      measure_physical_error(*line, PositionView(at.data(), sizeof(double), Precision::double_precision), truth);
  QVERIFY(std::abs(error.max - 0.4 / 2) < 1e-15);
  QVERIFY(std::abs(error.rms - 0.4 / std::sqrt(4.0) / 2) < 1e-15);
  QCOMPARE(error.moving, std::uint64_t{2});  // 0.01 is half a percent of the hand's
  QVERIFY(std::abs(error.moving_rms - 0.4 / std::sqrt(2.0) / 2) < 1e-15);
  QCOMPARE(error.moving_max, error.max);
  // An element moves from 1 % of the handle's displacement on: 0.02 here.
  for (const auto& [by, moving] : {std::pair(0.019, 2), {0.021, 3}}) {
    const Truth other{{-2, -1, -by, 0}, 2};
    QCOMPARE(
        int(measure_physical_error(*line, PositionView(at.data(), sizeof(double), Precision::double_precision), other)
                .moving),
        moving);
  }
}

/// Newton's method starts from rest each time: the answer is the same to the bit whatever was asked before.
void PhysicsTest::the_reference_solution_knows_nothing_of_the_last_one() {
  const Case sheet = pinned_sheet(25, {}, {});
  const std::vector<double> at_rest(2 * sheet.pins.size());
  TruthSolver solver({sheet.mesh, Cuts(sheet.mesh), sheet.pins, at_rest, {}});
  const ElementId hand = std::get<commands::Grab>(sheet.drags[0].commands[0]).element;
  const Point near = sheet.mesh->rest_position(hand) + Point(0.1, -0.05, 0), far = near + Point(0.6, -0.6, 0);
  const Truth first = solver.at(hand, near);
  QVERIFY(solver.at(hand, far).displacements != first.displacements);
  QVERIFY(chainmail::test::same_bits(solver.at(hand, near).displacements, first.displacements));
}

void PhysicsTest::everyone_takes_part() {
  for (const PhysicsObject& object : everything().objects) {
    QCOMPARE(object.drags.size(), std::size_t{3});
    for (const PhysicsDrag& one : object.drags) {
      QVERIFY2(one.no_truth.empty(), one.no_truth.c_str());
      QCOMPARE(one.entries.size(), 3 * algorithms().size() + elastic_algorithms().size());
      for (const PhysicsEntry& entry : one.entries) {
        const Algorithm algorithm = entry.contestant.algorithm;
        const bool fits =
            algorithm != Algorithm::original && (algorithm != Algorithm::boundary_elements || object.name == "bar");
        QVERIFY2(entry.measurement.has_value() == fits, entry.refusal.c_str());
        if (fits) {
          QVERIFY(entry.measurement->ms_per_move.median > 0);
          QCOMPARE(entry.measurement->prepare_ms > 0, elastic_method(algorithm).has_value());
        }
      }
    }
  }
}

void PhysicsTest::the_truth_has_no_error_and_linear_elasticity_less_for_less() {
  Case bar = pinned_bar(24, {}, {});
  const ElementId hand = std::get<commands::Grab>(bar.drags[0].commands[0]).element;
  bar.drags = {drag(*bar.mesh, hand, {0.4, 0.4, 0}), drag(*bar.mesh, hand, {0.04, 0.04, 0})};
  const auto report = compare_with_physics({bar}, quick({}, {0, 10}));
  const auto far = errors_of(report.objects[0].drags[0]), near = errors_of(report.objects[0].drags[1]);
  for (const auto& errors : {far, near}) {
    QVERIFY(errors.at({Algorithm::neo_hookean, 0}).max < converged);
    for (const auto& [contestant, error] : errors) {
      QVERIFY(contestant.first == Algorithm::neo_hookean || error.rms > 100 * converged);
      QVERIFY(error.max >= error.rms && error.moving_max <= error.max && error.moving_rms >= error.rms);
    }
  }
  // What linear elasticity leaves out is of second order: a tenth of the way has about a tenth of the error.
  const double ratio = near.at({Algorithm::linear_fem, 0}).rms / far.at({Algorithm::linear_fem, 0}).rms;
  QVERIFY2(ratio > 0.05 && ratio < 0.2, qPrintable(QString::number(ratio)));
  QVERIFY(far.at({Algorithm::exact, 0}) != far.at({Algorithm::exact, 10}));
  // It found them from where the hand went, not only from what the truth says.
  QVERIFY(far.at({Algorithm::linear_fem, 0}).rms < far.at({Algorithm::exact, 0}).rms);
}

void PhysicsTest::drags_are_what_they_say() {
  for (const Case& object : physics_cases({}, {})) {
    QCOMPARE(object.drags.size(), std::size_t{3});
    const double size = (bounds(*object.mesh)[1] - bounds(*object.mesh)[0]).maxCoeff();
    const ElementId hand = std::get<commands::Grab>(object.drags[0].commands[0]).element;
    std::vector<Point> ways;
    for (const RecordedMoves& one : object.drags) {
      QCOMPARE(one.commands.size(), std::size_t{25});
      ways.push_back(std::get<commands::Drag>(one.commands.back()).target - object.mesh->rest_position(hand));
    }
    QVERIFY(std::abs(ways[0].norm() - 0.05 * size) < 1e-12);
    QVERIFY(std::abs(ways[1].norm() - 0.2 * size) < 1e-12 && std::abs(ways[2].norm() - 0.2 * size) < 1e-12);
    QVERIFY(std::abs(ways[1].dot(ways[2])) < 1e-12);
    for (const ElementId pin : object.pins) {
      QVERIFY((object.mesh->rest_position(hand) - object.mesh->rest_position(pin)).norm() > size / 2);
    }
  }
}

void PhysicsTest::what_has_no_answer_is_refused_by_name() {
  const auto sentence_of = [](const Case& object) -> QString {
    try {
      compare_with_physics({object}, quick({Algorithm::exact}, {0}));
    } catch (const Error& error) {
      return QString::fromUtf8(error.what());
    }
    return {};
  };
  Case loose = pinned_sheet(25, {}, {});
  loose.pins.clear();
  QVERIFY(sentence_of(loose).startsWith("sheet: nothing pins it, so physics has no static answer; "));
  Case open = pinned_bar(24, {}, {});
  open.mesh = make_mesh(MeshKind::cloth, {4, 4, 1}, 3);  // it has no inside
  open.name = "hull";
  open.pins = {0};
  QVERIFY2(sentence_of(open).startsWith("hull: "), qPrintable(sentence_of(open)));
  Case flat = pinned_sheet(25, {}, {});
  flat.elastic.material.poisson = 0.5;
  QVERIFY(sentence_of(flat).contains("Poisson"));
  QVERIFY_EXCEPTION_THROWN(physics_drags(loose), Error);
}

void PhysicsTest::objects_grow() {
  QCOMPARE(everything().growths.size(), std::size_t{2});
  for (const PhysicsGrowth& growth : everything().growths) {
    std::set<Algorithm> seen;
    for (const GrowthSeries& series : growth.series) {
      seen.insert(series.contestant.algorithm);
      QVERIFY(!series.end.empty());
      for (std::size_t i = 0; i < series.points.size(); ++i) {
        QVERIFY(series.points[i].ms_per_move > 0);
        QVERIFY(i == 0 || series.points[i].elements > series.points[i - 1].elements);
      }
      if (series.contestant.algorithm == Algorithm::neo_hookean) {
        QVERIFY(series.points.at(0).error.value().max < converged);
      }
    }
    QCOMPARE(seen.size(), every_algorithm().size());
  }
}

void PhysicsTest::it_stops_at_once() {
  std::stop_source stop;
  stop.request_stop();
  const auto report = compare_with_physics({pinned_sheet(25, {}, {})}, quick({}, {0}), {}, stop.get_token());
  QVERIFY(report.stopped);
  QVERIFY(report.objects.at(0).drags.empty());
}

void PhysicsTest::the_page_is_well_formed_and_says_all() {
  std::ostringstream out;
  write_html(out, everything(), origin());
  QXmlStreamReader reader(QByteArray::fromStdString(out.str()));
  int drawings = 0, tables = 0, lines = 0;
  QString text;
  while (!reader.atEnd()) {
    reader.readNext();
    drawings += reader.isStartElement() && reader.name() == u"svg" ? 1 : 0;
    tables += reader.isStartElement() && reader.name() == u"table" ? 1 : 0;
    lines += reader.isStartElement() && reader.name() == u"polyline" ? 1 : 0;
    text += reader.isCharacters() ? reader.text() : QStringView();
  }
  QVERIFY2(!reader.hasError(), qPrintable(reader.errorString()));
  QCOMPARE(drawings, 1 + 2 + 3);
  QCOMPARE(tables, 4);
  const Plot overview = physics_overview(everything());
  QCOMPARE(overview.panels.size(), std::size_t{2});
  double mean = 0;
  for (const PhysicsDrag& one : everything().objects[0].drags) {
    mean += one.entries[0].measurement->error.rms / 3;
  }
  QVERIFY(std::abs(overview.panels[0].marks[0].y - mean) < 1e-15);
  QVERIFY(lines >= 2 * 3 * 5);  // an algorithm's sweeps are a line in each panel
  for (const AlgorithmInfo& one : every_algorithm()) {
    QVERIFY(text.contains(QString::fromUtf8(one.label.data(), int(one.label.size()))));
  }
  QVERIFY(text.contains("Young’s modulus 1, Poisson’s ratio 0.3"));
}

void PhysicsTest::csv_and_text_have_a_row_for_each() {
  std::ostringstream csv, text;
  write_csv(csv, everything());
  write_text(text, everything());
  std::istringstream lines(csv.str());
  std::string line;
  std::getline(lines, line);
  const auto columns = std::ranges::count(line, ',');
  std::size_t rows = 0;
  for (; std::getline(lines, line); ++rows) {
    if (line.find('"') == std::string::npos) {
      QCOMPARE(std::ranges::count(line, ','), columns);
    }
  }
  QVERIFY(rows >= 2 * 3 * (3 * algorithms().size() + elastic_algorithms().size()));
  const QString printed = QString::fromStdString(text.str());
  QCOMPARE(printed.count("\n  3D ChainMail"), 2 + 2);  // refused: once a table, whatever the sweeps
  QVERIFY(printed.contains("\n  Exact ChainMail, 10 sweeps "));
  QVERIFY(printed.contains("\n  BEM "));
}

QTEST_APPLESS_MAIN(PhysicsTest)
#include "test_physics.moc"
