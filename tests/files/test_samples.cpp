#include <QtTest>
#include <algorithm>
#include <cmath>

#include "files/mesh/input_file.h"
#include "files/results/summary.h"
#include "files/session/session.h"
#include "files/support.h"
#include "files/volume_of.h"
#include "folders.h"
#include "mesh/layers.h"
#include "mesh/refine.h"
#include "program.h"

namespace chainmail::test_samples {

using namespace chainmail::test;

/// The sample meshes match the description in their README.
class SamplesTest : public QObject {
  Q_OBJECT

 private slots:
  void samples_data();
  void samples();
  void the_inclusion_is_stiff_and_its_body_is_not();
  void the_organ_is_filled_from_its_surface();
  void the_coarse_organ_keeps_its_shape_when_it_is_refined();
  void the_phantom_is_stiff_where_it_is_dense();
  void every_file_in_the_folder_opens();

 private:
  static MeshPointer open(const char* name) { return open_mesh(source_file("meshes") / name).mesh; }
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
  // For closed surfaces, elements - links + faces is 2 on a sphere and 0 on a torus.
  QTest::newRow("sphere") << "sphere.obj" << 266U << 792U << 528U << 3;
  QTest::newRow("torus") << "torus.obj" << 384U << 768U << 2 * 384U << 3;
  QTest::newRow("organ") << "organ.obj" << 1212U << 3630U << 2420U << 3;
  QTest::newRow("organ, filled") << "organ.msh" << 2240U << 13340U << 0U << 3;
  QTest::newRow("organ, coarse") << "organ-coarse.msh" << 114U << 564U << 0U << 3;
  QTest::newRow("jittered") << "jittered.vtk" << 792U << 4563U << 0U << 3;
  QTest::newRow("phantom") << "phantom.nrrd" << 8120U << 22884U << 0U << 3;
  QTest::newRow("scan") << "scan.mha" << 2624U << 7132U << 0U << 3;
}

void SamplesTest::samples() {
  QFETCH(QString, name);
  const auto mesh = open(qPrintable(name));
  const auto summary = summarize(*mesh);
  QTEST(unsigned(summary.elements), "elements");
  QTEST(unsigned(summary.links), "links");
  QTEST(unsigned(summary.triangles), "triangles");
  QTEST(summary.space_dimension, "space");
  QCOMPARE(summary.components, std::uint64_t{1});
}

void SamplesTest::the_inclusion_is_stiff_and_its_body_is_not() {
  const Session session = read_session(source_file("meshes/inclusion.chainmail"));
  QCOMPARE(session.mesh->element_count(), 32U * 24);
  const LinkSoftness stiff{1, 1, 0};
  QVERIFY(session.softness->links.size() > 100 && session.softness->links.size() < session.mesh->link_count() / 10);
  QVERIFY(std::all_of(session.softness->links.begin(), session.softness->links.end(),
                      [&](const auto& link) { return link.second == stiff; }));
  QVERIFY(session.softness->global.compression < 0.5);
}

void SamplesTest::the_organ_is_filled_from_its_surface() {
  const auto hollow = open("organ.obj"), filled = open("organ.msh");
  // Gmsh keeps the surface's elements and their ids when it fills the surface.
  QVERIFY(filled->element_count() > hollow->element_count());
  for (ElementId element = 0; element < hollow->element_count(); ++element) {
    QVERIFY((filled->rest_position(element) - hollow->rest_position(element)).norm() <
            1e-6);  // rounded by STL in between
  }
}

/// It is the organ at a quarter of its size. Each refinement has eight cells of
/// an eighth of the volume for each cell, keeps its elements, and its surface is the same.
void SamplesTest::the_coarse_organ_keeps_its_shape_when_it_is_refined() {
  const auto fine = open("organ.msh");
  MeshPointer mesh = open("organ-coarse.msh");
  QVERIFY(volume_of(*mesh) > 0 && std::abs(volume_of(*mesh) * 64 / volume_of(*fine) - 1) < 0.1);
  for (int level = 0; level < 2; ++level) {
    const Refinement finer = refine(*mesh);
    QCOMPARE(finer.mesh->tetrahedra.size(), 8 * mesh->tetrahedra.size());
    for (std::size_t i = 0; i < finer.mesh->tetrahedra.size(); ++i) {
      const double whole = volume_of_cell(*mesh, mesh->tetrahedra[i / 8]);
      QVERIFY(std::abs(8 * volume_of_cell(*finer.mesh, finer.mesh->tetrahedra[i]) / whole - 1) < 1e-9);
    }
    for (ElementId e = 0; e < mesh->element_count(); ++e) {
      QCOMPARE(finer.mesh->rest_position(e), mesh->rest_position(e));
    }
    const std::vector<ElementId> before = boundary(*mesh), after = boundary(*finer.mesh);
    for (const ElementId e : after) {
      if (e >= mesh->element_count()) {
        for (const ElementId parent : finer.parents[e - mesh->element_count()]) {
          QVERIFY(std::ranges::binary_search(before, parent));
        }
      }
    }
    mesh = finer.mesh;
  }
  QVERIFY(mesh->tetrahedra.size() > 20'000 && mesh->tetrahedra.size() < 77'000);
}

void SamplesTest::the_phantom_is_stiff_where_it_is_dense() {
  const OpenedMesh phantom = open_mesh(source_file("meshes/phantom.nrrd"));
  QCOMPARE(phantom.mesh->texture->size, (std::array<std::uint32_t, 3>{32, 28, 26}));
  const auto [softest, stiffest] =
      std::minmax_element(phantom.softness.begin(), phantom.softness.end(),
                          [](const auto& a, const auto& b) { return a.second.compression < b.second.compression; });
  QVERIFY(stiffest->second.compression == 1 && softest->second.compression < 1);
}

void SamplesTest::every_file_in_the_folder_opens() {
  for (const auto& entry : std::filesystem::directory_iterator(source_file("meshes"))) {
    const std::filesystem::path& path = entry.path();
    QVERIFY2(std::filesystem::file_size(path) < 400'000, path.c_str());
    if (path.extension() == ".md" || path.extension() == ".py") {
      continue;
    }
    InputFile file = open_file(path);
    if (file.kind == FileKind::session) {
      QVERIFY(read_session(std::move(file.file)).mesh->element_count() > 0);
    } else if (file.kind == FileKind::picture) {
      QVERIFY(file_text(path).starts_with("\x89PNG\r\n"));  // the window opens it
    } else {
      const OpenedMesh opened = open_mesh(std::move(file));
      QVERIFY2(opened.flaws == MeshFlaws{}, path.c_str());
      QVERIFY2(opened.mesh->mean_link_length > 0.7 && opened.mesh->mean_link_length < 1.5, path.c_str());
    }
  }
}

CHAINMAIL_TEST(SamplesTest)

}  // namespace chainmail::test_samples

#include "test_samples.moc"
