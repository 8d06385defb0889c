#include <QtTest>
#include <cmath>
#include <limits>

#include "files/mesh/fill.h"
#include "files/support.h"
#include "files/volume_of.h"
#include "program.h"

namespace chainmail::test_fill {

using namespace chainmail::test;

namespace {

/// Returns an octahedron of radius 3 with the first `faces` of its eight faces, as OBJ.
std::string octahedron(int faces) {
  std::string text = "v 3 0 0\nv -3 0 0\nv 0 3 0\nv 0 -3 0\nv 0 0 3\nv 0 0 -3\n";
  const char* all[] = {"f 1 3 5\n", "f 3 2 5\n", "f 2 4 5\n", "f 4 1 5\n",
                       "f 3 1 6\n", "f 2 3 6\n", "f 4 2 6\n", "f 1 4 6\n"};
  for (int i = 0; i < faces; ++i) {
    text += all[i];
  }
  return text;
}

}  // namespace

/// Closed surfaces are filled; for others, an error gives the position of the gap.
class FillTest : public QObject {
  Q_OBJECT

 private slots:
  void a_closed_surface_becomes_a_volume();
  void smaller_edges_make_more_elements();
  void surfaces_that_enclose_nothing_are_refused_data();
  void surfaces_that_enclose_nothing_are_refused();
  void too_many_tetrahedra_are_refused_before_they_are_made();
  void sizes_are_numbers_above_0();
  void it_can_be_cancelled();
};

void FillTest::a_closed_surface_becomes_a_volume() {
  const auto surface = obj(octahedron(8));
  const auto filled = fill(*surface, 1);
  double volume = 0;
  for (const auto& cell : filled->tetrahedra) {
    QVERIFY(volume_of_cell(*filled, cell) > 0);
    volume += volume_of_cell(*filled, cell);
  }
  QVERIFY(std::abs(volume - 36) < 1e-9);  // volume 4/3 r³; rounding of sums of some hundred doubles
  for (ElementId e = 0; e < surface->element_count(); ++e) {
    QCOMPARE(filled->rest_position(e), surface->rest_position(e));
  }
}

void FillTest::smaller_edges_make_more_elements() {
  const auto surface = obj(octahedron(8));
  const auto coarse = fill(*surface, 2)->element_count(), fine = fill(*surface, 0.5)->element_count();
  QVERIFY2(fine > 4 * coarse, qPrintable(QString("%1 and %2").arg(coarse).arg(fine)));
}

void FillTest::surfaces_that_enclose_nothing_are_refused_data() {
  QTest::addColumn<QByteArray>("text");
  QTest::addColumn<QString>("sentence");
  QTest::newRow("hole") << QByteArray::fromStdString(octahedron(7))
                        << "surface: the surface is open: it has 1 hole, the first at element 0, near (3, 0, 0); ";
  QTest::newRow("lines") << QByteArray("v 0 0 0\nv 1 0 0\nl 1 2\n")
                         << "surface: it has no faces, so it has no inside; ";
  QTest::newRow("three at a link") << QByteArray::fromStdString(octahedron(8) + "v 9 9 9\nf 1 3 7\n")
                                   << "surface: 3 faces meet at the link 0-2, near (3, 0, 0); ";
  // A second octahedron, with one corner inside the first.
  std::string two = octahedron(8) + "v 8 0 0\nv 2 0 0\nv 5 3 0\nv 5 -3 0\nv 5 0 3\nv 5 0 -3\n";
  for (const char* face : {"f 7 9 11\n", "f 9 8 11\n", "f 8 10 11\n", "f 10 7 11\n", "f 9 7 12\n", "f 8 9 12\n",
                           "f 10 8 12\n", "f 7 10 12\n"}) {
    two += face;
  }
  QTest::newRow("crossing") << QByteArray::fromStdString(two) << "surface: the surface intersects itself, at ";
}

void FillTest::surfaces_that_enclose_nothing_are_refused() {
  QFETCH(QByteArray, text);
  QFETCH(QString, sentence);
  const QString error = error_of([&] { fill(*obj(text.toStdString()), 1); });
  QVERIFY2(error.startsWith(sentence), qPrintable(error));
}

/// Edges of 0.01 in a volume of 36 need more elements than the limit of 20 million. This would take hours, and is
/// refused at once. Edges of 0.1 are accepted.
void FillTest::too_many_tetrahedra_are_refused_before_they_are_made() {
  const Progress job = Progress::watched();
  const Patience patience(job);
  try {
    fill(*obj(octahedron(8)), 0.01, job);
    QFAIL("it was filled");
  } catch (const Error& error) {
    QCOMPARE(
        QString(error.what()),
        QString("surface: filled with edges of that size it would have more than %1 elements; choose a larger size")
            .arg(element_limit));
  } catch (const Cancelled&) {
    QFAIL("it begins to fill it");
  }
}

void FillTest::sizes_are_numbers_above_0() {
  for (const double size : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    const QString error = error_of([&] { fill(*obj(octahedron(8)), size); });
    QVERIFY2(error.startsWith("size: it must be a number above 0"), qPrintable(error));
  }
}

void FillTest::it_can_be_cancelled() {
  const Progress job = Progress::watched();
  job.cancel();
  QVERIFY_THROWS_EXCEPTION(Cancelled, fill(*obj(octahedron(8)), 0.05, job));
}

CHAINMAIL_TEST(FillTest)

}  // namespace chainmail::test_fill

#include "test_fill.moc"
