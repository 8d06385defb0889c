#include <QtTest>
#include <algorithm>
#include <map>

#include "files/session.h"
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
  void the_inclusion_is_stiff_and_its_body_is_not();
  void every_file_in_the_folder_opens();
};

void SamplesTest::samples_data() {
  QTest::addColumn<QString>("name");
  QTest::addColumn<unsigned>("elements");
  QTest::addColumn<unsigned>("links");
  QTest::addColumn<unsigned>("triangles");
  QTest::addColumn<int>("space");
  QTest::newRow("line") << "line.dat" << 40U << 39U << 0U << 1;
  QTest::newRow("3x3") << "3x3.dat" << 9U << 12U << 0U << 2;
  QTest::newRow("grid") << "grid.dat" << 576U << 1104U << 0U << 2;
  QTest::newRow("cloth") << "cloth.obj" << 384U << 1073U << 690U << 2;
  // Closed: elements - links + faces is 2 on a sphere and 0 on a torus.
  QTest::newRow("sphere") << "sphere.obj" << 266U << 792U << 528U << 3;
  QTest::newRow("torus") << "torus.obj" << 384U << 768U << 2 * 384U << 3;
  QTest::newRow("organ") << "organ.obj" << 1212U << 3630U << 2420U << 3;
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

void SamplesTest::the_inclusion_is_stiff_and_its_body_is_not() {
  const Session session = read_session(std::filesystem::path(SAMPLES) / "inclusion.chainmail");
  QCOMPARE(session.mesh->element_count(), 32U * 24);
  const LinkSoftness stiff{1, 1, 0};
  QVERIFY(session.softness->links.size() > 100 && session.softness->links.size() < session.mesh->link_count() / 10);
  QVERIFY(std::all_of(session.softness->links.begin(), session.softness->links.end(),
                      [&](const auto& link) { return link.second == stiff; }));
  QVERIFY(session.softness->global.compression < 0.5);
}

void SamplesTest::every_file_in_the_folder_opens() {
  // What readers of other rooms open, or none yet, by how such a file begins.
  const std::map<std::string, std::string> beginnings{{".md", "# Samples\n"},
                                                      {".py", "#!/usr/bin/env python3\n"},
                                                      {".png", "\x89PNG\r\n"},
                                                      {".msh", "$MeshFormat\n4.1 0 8\n"},
                                                      {".vtk", "# vtk DataFile Version 3.0\n"},
                                                      {".nrrd", "NRRD0004\n"},
                                                      {".mha", "ObjectType = Image\n"}};
  int opened = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SAMPLES)) {
    const std::filesystem::path& path = entry.path();
    QVERIFY2(std::filesystem::file_size(path) < 400'000, path.c_str());
    if (const auto beginning = beginnings.find(path.extension().string()); beginning != beginnings.end()) {
      QVERIFY2(file_text(path).starts_with(beginning->second), path.c_str());
    } else if (is_session(path)) {
      QVERIFY(read_session(path).mesh->element_count() > 0);
      ++opened;
    } else {
      QVERIFY(read_mesh(path)->element_count() > 0);
      ++opened;
    }
  }
  QVERIFY(opened > 0);
}

QTEST_APPLESS_MAIN(SamplesTest)
#include "test_samples.moc"
