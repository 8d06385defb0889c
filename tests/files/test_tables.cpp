#include <QtTest>
#include <cmath>
#include <sstream>

#include "files/formats/positions_csv.h"
#include "files/results/trace_csv.h"
#include "files/support.h"
#include "program.h"

namespace chainmail::test_tables {

using namespace chainmail::test;

/// Tests positions and traces as CSV.
class TablesTest : public QObject {
  Q_OBJECT

 private slots:
  void positions();
  void float_positions_are_told_exactly();
  void axes_not_carried_print_their_constant();
  void traces();
};

void TablesTest::positions() {
  const auto mesh = made(MeshKind::grid, {2, 1, 1}, 1, 2);
  const std::vector<double> at{0.1, -0.0, std::nextafter(1.0, 2.0), 1e-300};
  std::ostringstream out;
  write_positions_csv(out, {*mesh, {}, {at.data(), 2 * sizeof(double), Precision::double_precision}, {}});
  QCOMPARE(out.str(), std::string("id,x,y,z\n0,0.1,-0,0\n1,1.0000000000000002,1e-300,0\n"));
}

void TablesTest::float_positions_are_told_exactly() {
  const auto mesh = made(MeshKind::line, {1, 1, 1});
  const float at = 0.1F;
  std::ostringstream out;
  write_positions_csv(out, {*mesh, {}, {&at, sizeof(float), Precision::single_precision}, {}});
  QCOMPARE(out.str(), std::string("id,x,y,z\n0,0.10000000149011612,0,0\n"));
}

void TablesTest::axes_not_carried_print_their_constant() {
  MeshParts parts;
  parts.rest = {{5, 0, 7}, {5, 1, 7}};
  const auto mesh = build_mesh(parts);
  std::ostringstream out;
  write_positions_csv(out, {*mesh, {}, {mesh->rest.data(), sizeof(double), Precision::double_precision}, {}});
  QCOMPARE(out.str(), std::string("id,x,y,z\n0,5,0,7\n1,5,1,7\n"));
}

void TablesTest::traces() {
  std::ostringstream out;
  write_trace_csv(out, {{{3, 1, true}, {4, 3, false}}, {}, {{1, 0, false}, {2, no_element, true}}});
  QCOMPARE(out.str(), std::string("pass,order,element,sponsor,moved\n0,0,3,1,1\n0,1,4,3,0\n2,0,1,0,0\n2,1,2,-1,1\n"));
}

CHAINMAIL_TEST(TablesTest)

}  // namespace chainmail::test_tables

#include "test_tables.moc"
