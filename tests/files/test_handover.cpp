#include <QtTest>
#include <random>

#include "files/import/handover.h"
#include "files/support.h"
#include "program.h"

namespace chainmail::test_handover {

using namespace chainmail::test;

namespace {

ImportedMesh sample() {
  ImportedMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.parts.rest.emplace_back(i & 1, i >> 1 & 1, i >> 2);
  }
  mesh.parts.links = {{0, 7}};
  mesh.parts.triangles = {{0, 1, 2}};
  mesh.parts.polygons = {4, 0, 1, 3, 2};
  mesh.parts.tetrahedra = {{0, 1, 2, 4}};
  mesh.parts.hexahedra = {{0, 1, 3, 2, 4, 5, 7, 6}};
  mesh.unused = 3;
  return mesh;
}

}  // namespace

/// Tests the data from the import program: they arrive unchanged, and damaged data are refused.
class HandoverTest : public QObject {
  Q_OBJECT

 private slots:
  void a_mesh_comes_over_whole();
  void a_volume_comes_over_whole();
  void a_refusal_comes_over_in_one_line();
  void cut_off_anywhere_it_is_damaged();
  void changed_anywhere_it_is_damaged_or_another_mesh();
  void coordinates_must_be_finite();
  void merged_voxels_must_be_possible();
};

void HandoverTest::a_mesh_comes_over_whole() {
  const auto mesh = std::get<ImportedMesh>(decode_imported(encode_imported(sample()), "a.msh"));
  const auto expected = sample();
  QCOMPARE(mesh.parts.rest, expected.parts.rest);
  QCOMPARE(mesh.parts.links, expected.parts.links);
  QCOMPARE(mesh.parts.triangles, expected.parts.triangles);
  QCOMPARE(mesh.parts.polygons, expected.parts.polygons);
  QCOMPARE(mesh.parts.tetrahedra, expected.parts.tetrahedra);
  QCOMPARE(mesh.parts.hexahedra, expected.parts.hexahedra);
  QCOMPARE(mesh.unused, std::uint64_t{3});
}

void HandoverTest::a_volume_comes_over_whole() {
  Volume volume;
  volume.size = {2, 1, 1};
  volume.merged = 3;
  volume.spacing = Point(1, 2, 3);
  volume.origin = Point(-1, 0, 1);
  volume.densities = {7, 65535};
  volume.lowest = -2;
  volume.step = 0.5;
  const auto again = std::get<Volume>(decode_imported(encode_imported(volume), "a.nrrd"));
  QVERIFY(again.size == volume.size && again.spacing == volume.spacing && again.origin == volume.origin);
  QCOMPARE(again.densities, volume.densities);
  QCOMPARE(again.merged, 3U);
  QCOMPARE(again.density(0), 1.5);
}

void HandoverTest::a_refusal_comes_over_in_one_line() {
  const auto refusal = std::get<Refusal>(decode_imported(encode_imported(Refusal{"bad\nline", "mend it"}), "a"));
  QCOMPARE(refusal.problem, std::string("bad\\x0aline"));
  QCOMPARE(refusal.remedy, std::string("mend it"));
}

void HandoverTest::cut_off_anywhere_it_is_damaged() {
  const auto bytes = encode_imported(sample());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const auto part = std::span(bytes).first(size);
    QVERIFY(error_of([&] { decode_imported(part, "a.msh"); }).startsWith("a.msh: the answer of the import program"));
  }
}

void HandoverTest::changed_anywhere_it_is_damaged_or_another_mesh() {
  const auto whole = encode_imported(sample());
  std::mt19937 random(1);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    auto bytes = whole;
    bytes[at] = std::byte(random() & 255);
    try {
      const auto imported = decode_imported(bytes, "a.msh");
      if (const auto* mesh = std::get_if<ImportedMesh>(&imported)) {
        for (const auto& link : mesh->parts.links) {
          QVERIFY(link[0] < mesh->parts.rest.size() && link[1] < mesh->parts.rest.size());
        }
      }
    } catch (const Error& error) {
      QVERIFY(QString(error.what()).startsWith("a.msh: "));
    }
  }
}

void HandoverTest::merged_voxels_must_be_possible() {
  Volume volume;
  volume.size = {2, 1, 1};
  volume.spacing = Point(1, 1, 1);
  volume.densities = {7, 8};
  for (const std::uint32_t merged : {0U, ~0U}) {
    volume.merged = merged;
    QVERIFY(error_of([&] { decode_imported(encode_imported(volume), "a.nrrd"); }).startsWith("a.nrrd: the answer of"));
  }
}

void HandoverTest::coordinates_must_be_finite() {
  for (const double bad : {std::nan(""), HUGE_VAL, -1e101}) {
    auto mesh = sample();
    mesh.parts.rest[2][1] = bad;
    QVERIFY(error_of([&] {
              decode_imported(encode_imported(mesh), "a.ply");
            }).startsWith("a.ply: point 2 has a coordinate that is not a number, or is beyond 1e100; "));
  }
}

CHAINMAIL_TEST(HandoverTest)

}  // namespace chainmail::test_handover

#include "test_handover.moc"
