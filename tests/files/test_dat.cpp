#include <QtTest>

#include "files/support.h"
#include "program.h"

namespace chainmail::test_dat {

using namespace chainmail::test;

namespace {

// The example of the thesis (Dean 2004, 4.3), with rows and neighbours in a different order.
const std::string three_by_three =
    "8 2 7 5\n0 2 3 1\n1 3 4 2 0\n2 2 1 5\n"
    "3 3 0 4 6\n4 4 7 5 3 1\n5 3 2 4 8\n\n# a comment\n6 2 3 7 # another\n7 3 4 6 8\n";

}  // namespace

/// Tests reading and writing of the format of the thesis.
class DatTest : public QObject {
  Q_OBJECT

 private slots:
  void rows_stand_in_any_order_and_neighbours_keep_theirs();
  void elements_stand_in_the_lattice();
  void the_size_comes_from_option_comment_or_name();
  void only_the_exact_name_gives_a_size();
  void the_space_dimension_is_stated_where_it_is_not_seen();
  void other_line_ends_and_a_mark_are_read();
  void links_may_be_added_and_removed_by_hand();
  void writing_and_reading_is_the_identity_data();
  void writing_and_reading_is_the_identity();
  void cut_links_are_left_out();
  void the_file_reads_as_documented();
  void a_mesh_without_lattice_is_refused();
};

void DatTest::rows_stand_in_any_order_and_neighbours_keep_theirs() {
  const auto mesh = dat(three_by_three, "3x3.dat");
  QCOMPARE(mesh->element_count(), 9U);
  QCOMPARE(mesh->link_count(), 12U);
  const auto row = [&](ElementId e) {
    const auto span = mesh->neighbours_of(e);
    return std::vector<ElementId>(span.begin(), span.end());
  };
  QCOMPARE(row(0), (std::vector<ElementId>{3, 1}));
  QCOMPARE(row(4), (std::vector<ElementId>{7, 5, 3, 1}));
  QCOMPARE(row(8), (std::vector<ElementId>{7, 5}));
  QVERIFY(mesh->triangles.empty() && mesh->tetrahedra.empty());
}

void DatTest::elements_stand_in_the_lattice() {
  ReadOptions options;
  options.size = {2, 2, 2};
  options.spacing = 0.5;
  const auto mesh = dat("0 0\n1 0\n2 0\n3 0\n4 0\n5 0\n6 0\n7 0\n", "x.dat", options);
  QVERIFY(mesh->rest_position(0) == Point(0, 0, 0));
  QVERIFY(mesh->rest_position(1) == Point(0.5, 0, 0));
  QVERIFY(mesh->rest_position(2) == Point(0, 0.5, 0));
  QVERIFY(mesh->rest_position(7) == Point(0.5, 0.5, 0.5));
  QCOMPARE(mesh->space_dimension, 3);
}

void DatTest::the_size_comes_from_option_comment_or_name() {
  const std::string rows = "0 1 1\n1 1 0\n2 0\n3 0\n";
  ReadOptions options;
  options.size = {4, 1, 1};
  const std::array<std::uint32_t, 3> by_option{4, 1, 1}, by_comment{1, 4, 1}, by_name{2, 2, 1};
  QVERIFY(dat("# size 1 4\n" + rows, "2x2.dat", options)->lattice->size == by_option);
  QVERIFY(dat("# size 1 4\n" + rows, "2x2.dat")->lattice->size == by_comment);
  QVERIFY(dat(rows, "folder/2x2.dat")->lattice->size == by_name);
  QVERIFY(dat(rows, "2x2x1.dat")->lattice->size == by_name);
  QCOMPARE(dat("# spacing 3\n" + rows, "2x2.dat")->lattice->spacing, 3.0);
  options.spacing = 2;
  QCOMPARE(dat("# spacing 3\n" + rows, "2x2.dat", options)->lattice->spacing, 2.0);
}

void DatTest::only_the_exact_name_gives_a_size() {
  for (const char* name : {"my2x2.dat", "2x2b.dat", "2x2 (1).dat", "4.dat", "2x.dat", "0x4.dat", "2x2x1x1.dat"}) {
    const auto error = error_of([&] { dat("0 0\n1 0\n2 0\n3 0\n", name); });
    QVERIFY2(error.contains("the size of its lattice is not known; use --size WxH[xD]"), qPrintable(error));
  }
}

void DatTest::the_space_dimension_is_stated_where_it_is_not_seen() {
  const auto flat = made(MeshKind::grid, {3, 2, 1});
  const auto in_space = made(MeshKind::grid, {3, 2, 1}, 1, 3);
  QVERIFY(dat_text(*flat).find("# space") == std::string::npos);
  QVERIFY(dat_text(*in_space).find("# space 3\n") != std::string::npos);
  QCOMPARE(dat(dat_text(*in_space))->space_dimension, 3);
  ReadOptions options;
  options.space_dimension = 2;
  QCOMPARE(dat(dat_text(*in_space), "mesh.dat", options)->space_dimension, 2);
}

void DatTest::other_line_ends_and_a_mark_are_read() {
  const auto mesh = dat("\xef\xbb\xbf# size 2\r\n0\t1  1\r\n1 1 0");
  QCOMPARE(mesh->link_count(), 1U);
}

void DatTest::links_may_be_added_and_removed_by_hand() {
  // The diagonal 0-3 is added, and the links 0-1 and 0-2 are removed.
  const auto mesh = dat("# size 2 2\n0 1 3\n1 1 3\n2 1 3\n3 3 0 2 1\n");
  QCOMPARE(mesh->link_count(), 3U);
  QVERIFY(find_link(*mesh, 0, 3) && !find_link(*mesh, 0, 1));
}

void DatTest::writing_and_reading_is_the_identity_data() {
  QTest::addColumn<int>("kind");
  QTest::newRow("line") << int(MeshKind::line);
  QTest::newRow("grid") << int(MeshKind::grid);
  QTest::newRow("cloth") << int(MeshKind::cloth);
  QTest::newRow("block") << int(MeshKind::block);
  QTest::newRow("tetra") << int(MeshKind::tetra);
}

void DatTest::writing_and_reading_is_the_identity() {
  QFETCH(int, kind);
  const auto mesh = made(MeshKind(kind), {4, 3, 2}, 0.1);
  const auto read = dat(dat_text(*mesh));
  QCOMPARE(read->links, mesh->links);
  QCOMPARE(read->neighbours, mesh->neighbours);
  QCOMPARE(read->rest, mesh->rest);
  QCOMPARE(dat_text(*read), dat_text(*mesh));
  const auto shuffled = dat(three_by_three, "3x3.dat");
  QCOMPARE(dat(dat_text(*shuffled))->neighbours, shuffled->neighbours);
}

void DatTest::cut_links_are_left_out() {
  const auto mesh = made(MeshKind::line, {3, 1, 1});
  Cuts cuts(mesh);
  cuts.cut(*find_link(*mesh, 0, 1));
  QCOMPARE(dat_text(*mesh, cuts), std::string("# size 3\n# spacing 1\n0 0\n1 1 2\n2 1 1\n"));
}

void DatTest::the_file_reads_as_documented() {
  QCOMPARE(dat_text(*made(MeshKind::grid, {2, 2, 1}, 0.5)),
           std::string("# size 2 2\n# spacing 0.5\n0 2 1 2\n1 2 0 3\n2 2 0 3\n3 2 1 2\n"));
  QVERIFY(dat_text(*made(MeshKind::block, {1, 1, 2})).starts_with("# size 1 1 2\n"));
}

void DatTest::a_mesh_without_lattice_is_refused() {
  const auto mesh = obj("v 0 0 0\nv 1 0 0\nl 1 2\n");
  QVERIFY(error_of([&] { dat_text(*mesh); }).contains("the format can only store lattices"));
  const QTemporaryDir folder;
  const std::string path = folder.filePath("a.dat").toStdString();
  const auto error = error_of([&] { save_mesh(path, {*mesh, {}, rest_positions(*mesh), {}}); });
  QVERIFY2(error.startsWith(QString::fromStdString(path) + ": a .dat file can only store lattices"), qPrintable(error));
  QVERIFY(!std::filesystem::exists(path));
}

CHAINMAIL_TEST(DatTest)

}  // namespace chainmail::test_dat

#include "test_dat.moc"
