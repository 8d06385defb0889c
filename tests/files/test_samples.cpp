#include <QtTest>

#include "files/summary.h"
#include "files/support.h"

using namespace chainmail;
using namespace chainmail::test;

/// The sample meshes are what their README says.
class SamplesTest : public QObject {
  Q_OBJECT

 private slots:
  void samples_data();
  void samples();
  void every_mesh_in_the_folder_reads();
};

void SamplesTest::samples_data() {
  QTest::addColumn<QString>("name");
  QTest::addColumn<unsigned>("elements");
  QTest::addColumn<unsigned>("links");
  QTest::addColumn<unsigned>("triangles");
  QTest::addColumn<int>("space");
  QTest::newRow("3x3") << "3x3.dat" << 9U << 12U << 0U << 2;
  QTest::newRow("grid") << "grid.dat" << 576U << 1104U << 0U << 2;
  // Closed: elements - links + faces is 2 on a sphere and 0 on a torus.
  QTest::newRow("sphere") << "sphere.obj" << 266U << 792U << 528U << 3;
  QTest::newRow("torus") << "torus.obj" << 384U << 768U << 2 * 384U << 3;
}

void SamplesTest::samples() {
  QFETCH(QString, name);
  const auto mesh = read_mesh(std::filesystem::path(SAMPLES) / name.toStdString());
  const auto summary = summarize(*mesh);
  QTEST(unsigned(summary.elements), "elements");
  QTEST(unsigned(summary.links), "links");
  QTEST(unsigned(summary.triangles), "triangles");
  QTEST(summary.space_dimension, "space");
  QCOMPARE(summary.components, std::uint64_t{1});
}

void SamplesTest::every_mesh_in_the_folder_reads() {
  for (const auto& entry : std::filesystem::directory_iterator(SAMPLES)) {
    if (entry.path().extension() != ".md") {
      QVERIFY(read_mesh(entry.path())->element_count() > 0);
    }
  }
}

QTEST_APPLESS_MAIN(SamplesTest)
#include "test_samples.moc"
