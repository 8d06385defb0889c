#include <QtTest>
#include <algorithm>
#include <functional>

#include "core/elastic/elastic_problems.h"
#include "measure/converging_reference.h"
#include "mesh/error.h"
#include "program.h"

namespace chainmail::test_converging_reference {

using namespace chainmail::test;

/// A reference solution that is refined until it changes little.
class ConvergingReferenceTest : public QObject {
  Q_OBJECT

 private slots:
  void a_sheet_converges();
  void a_solid_says_why_it_ends();
  void every_level_is_computed_where_it_is_asked_for();
  void cut_cells_are_missing_on_all_levels();
  void a_second_drag_is_as_on_its_own();
  void a_patch_is_the_same_on_every_mesh();
};

namespace {

ElasticProblem sheet_problem(std::uint32_t width) {
  const auto mesh = make_mesh(MeshKind::cloth, {width, width, 1}, {}, 8.0 / (width - 1));
  return pinned(mesh, layer(*mesh, *find_side("top")));
}

const Patch corner{Point(8, 0, 0), 2.0}, bottom{Point(4, -1000, 0), 1000.01};
const Point way(1, -1, 0);

double rms(const std::vector<double>& values) {
  double sum = 0;
  for (const double one : values) {
    sum += one * one;
  }
  return std::sqrt(sum / double(values.size()));
}

}  // namespace

/// The changes fall, by less than 2 % in the end, and the answer at the object's elements is closer to that on a mesh
/// that is fine from the start than the answer on its own cells.
void ConvergingReferenceTest::a_sheet_converges() {
  const ElasticProblem problem = sheet_problem(5);
  constexpr double change = converged_change / 4;
  ConvergingReference reference(problem, {.change = change, .seconds = 1e9});
  const ConvergedReference result = reference.at(bottom, way);
  QVERIFY2(result.converged, qPrintable(QString::fromStdString(result.end)));
  QCOMPARE(result.levels.front().elements, 25u);
  QCOMPARE(result.levels[1].elements, 81u);
  QVERIFY(!result.levels.front().change && *result.levels.back().change < change);
  for (std::size_t i = 2; i < result.levels.size(); ++i) {
    QVERIFY(*result.levels[i].change < *result.levels[i - 1].change);
  }
  QVERIFY(result.order && *result.order > 0.5);
  const auto at_elements = [](std::uint32_t width) {
    ConvergingReference on_mesh(sheet_problem(width), {.max_levels = 1});
    const ConvergedReference fine = on_mesh.at(bottom, way);
    std::vector<double> found;
    const std::uint32_t step = (width - 1) / 4;
    for (std::uint32_t y = 0; y < 5; ++y) {
      for (std::uint32_t x = 0; x < 5; ++x) {
        const std::size_t e = std::size_t{step * y} * width + step * x;
        found.insert(found.end(), {fine.solution.displacements[2 * e], fine.solution.displacements[2 * e + 1]});
      }
    }
    return found;
  };
  const auto apart = [&](std::vector<double> from, const std::vector<double>& to) {
    for (std::size_t i = 0; i < to.size(); ++i) {
      from[i] -= to[i];
    }
    return rms(from) / rms(to);
  };
  const std::vector<double> own = at_elements(5), fine = at_elements(65);
  QVERIFY(apart(result.solution.displacements, fine) < 0.05);
  QVERIFY(apart(own, fine) > 2 * apart(result.solution.displacements, fine));
  // The handle's elements are where they were put, and known to be prescribed.
  const auto handle = elements_in(*problem.mesh, bottom);
  QCOMPARE(handle.size(), std::size_t(5));
  QCOMPARE(result.solution.prescribed.size(), problem.pins.size() + handle.size());
  for (const ElementId e : handle) {
    QCOMPARE(result.solution.displacements[2 * e], way.x());
    QCOMPARE(result.solution.displacements[2 * e + 1], way.y());
  }
}

void ConvergingReferenceTest::a_solid_says_why_it_ends() {
  const auto bar = make_mesh(MeshKind::tetra, {5, 2, 2});
  const ElasticProblem problem = pinned(bar, layer(*bar, *find_side("left")));
  ConvergingReference reference(problem, {.change = 0, .seconds = 1e9});
  const ConvergedReference result = reference.at({Point(4, 0, 0), 1.5}, {0, 0, 0.5});
  QVERIFY(!result.converged && result.levels.size() >= 3);
  QVERIFY2(result.end.find("more than 12000") != std::string::npos, result.end.c_str());
  QVERIFY(result.order.has_value());
  ConvergingReference hurried(problem, {.change = 0, .seconds = 0});
  const ConvergedReference early = hurried.at({Point(4, 0, 0), 1.5}, {0, 0, 0.5});
  QCOMPARE(early.levels.size(), std::size_t(1));
  QCOMPARE(early.end, std::string("its time is used up"));
}

void ConvergingReferenceTest::every_level_is_computed_where_it_is_asked_for() {
  const auto levels = [](bool every) {
    ConvergingReference reference(sheet_problem(5),
                                  {.change = 1, .seconds = 1e9, .max_levels = 3, .every_level = every});
    const ConvergedReference result = reference.at(bottom, way);
    return std::pair(result.converged ? result.levels.size() : 0, result.end);
  };
  QCOMPARE(levels(false), std::pair(std::size_t{2}, std::string("it has converged")));
  QCOMPARE(levels(true), std::pair(std::size_t{3}, std::string("it has converged")));
}

void ConvergingReferenceTest::cut_cells_are_missing_on_all_levels() {
  ElasticProblem problem = sheet_problem(5);
  const ConvergedReference whole = ConvergingReference(problem, {.max_levels = 2}).at(corner, way);
  problem.cuts.cut(*find_link(*problem.mesh, 6, 7));
  const ConvergedReference cut = ConvergingReference(problem, {.max_levels = 2}).at(corner, way);
  QVERIFY(cut.levels[1].elements < whole.levels[1].elements);
  QVERIFY(cut.solution.displacements != whole.solution.displacements);
}

void ConvergingReferenceTest::a_second_drag_is_as_on_its_own() {
  ConvergingReference reference(sheet_problem(5), {.max_levels = 2}), fresh(sheet_problem(5), {.max_levels = 2});
  const ConvergedReference first = reference.at(bottom, way), second = reference.at(corner, way),
                           own = fresh.at(corner, way);
  QCOMPARE(second.levels.size(), std::size_t{2});
  const std::vector<double>&is = second.solution.displacements, &should = own.solution.displacements;
  std::vector<double> apart(is.size());
  std::ranges::transform(is, should, apart.begin(), std::minus());
  QVERIFY2(rms(apart) < 1e-6 * rms(should), qPrintable(QString::number(rms(apart) / rms(should))));
  QVERIFY(first.solution.displacements != is);
}

void ConvergingReferenceTest::a_patch_is_the_same_on_every_mesh() {
  const MeshPointer coarse = sheet_problem(5).mesh, fine = sheet_problem(9).mesh;
  QCOMPARE(elements_in(*coarse, corner).size(), std::size_t(3));
  QCOMPARE(elements_in(*fine, corner).size(), std::size_t(6));
  QCOMPARE(elements_in(*coarse, corner, {4}).size(), std::size_t(2));
  ConvergingReference reference(sheet_problem(5));
  QVERIFY_THROWS_EXCEPTION(Error, reference.at({Point(50, 0, 0), 1}, way));
}

CHAINMAIL_TEST(ConvergingReferenceTest)

}  // namespace chainmail::test_converging_reference

#include "test_converging_reference.moc"
