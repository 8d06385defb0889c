#include <QTemporaryDir>
#include <QtTest>
#include <algorithm>
#include <fstream>

#include "core/api/api_support.h"
#include "folders.h"
#include "program.h"

namespace chainmail::test_api {

/// The public interface: meshes, files and bodies. What goes in comes out, and bad input changes nothing.
class ApiTest : public QObject {
  Q_OBJECT

 private slots:
  void a_mesh_states_its_facts();
  void arrays_make_a_mesh();
  void bad_arrays_are_refused_data();
  void bad_arrays_are_refused();
  void bad_meshes_are_refused();
  void foreign_files_are_read();
  void bad_files_are_refused();
  void positions_go_in_and_out();
  void bodies_are_independent();
  void a_frame_turns_the_regions();
  void bad_input_of_a_body_changes_nothing();
};

void ApiTest::a_mesh_states_its_facts() {
  const cm::Mesh grid = cm::make_grid(4, 3, {.spacing = 2});
  QCOMPARE(grid.element_count(), 12u);
  QCOMPARE(grid.link_count(), 17u);
  QVERIFY(std::ranges::equal(grid.neighbours(5), std::vector<cm::ElementId>{1, 4, 6, 9}));
  const auto link = grid.find_link(6, 5);
  QVERIFY(link && (grid.link(*link) == std::array<cm::ElementId, 2>{5, 6}));
  QVERIFY(!grid.find_link(0, 5));
  QVERIFY((grid.rest_position(5) == cm::Vector3{2, 2, 0}));
  QCOMPARE(grid.rest_positions().size(), std::size_t(36));
  QCOMPARE(grid.rest_positions()[15], 2.0);
  QCOMPARE(grid.rest_length(0), 2.0);
  QCOMPARE(grid.mean_rest_length(), 2.0);
  QVERIFY((grid.bounds() == std::array{cm::Vector3{0, 0, 0}, cm::Vector3{6, 4, 0}}));
  QCOMPARE(grid.object_dimension(), 2);
  QCOMPARE(grid.space_dimension(), 2);
  QCOMPARE(grid.part_count(), 1u);
  QVERIFY(grid.is_grid() && (*grid.lattice() == std::array<std::uint32_t, 3>{4, 3, 1}));
  QVERIFY((grid.side("left") == std::vector<cm::ElementId>{0, 4, 8}));
  QVERIFY((grid.side("top") == std::vector<cm::ElementId>{8, 9, 10, 11}));
  QCOMPARE(grid.side("boundary").size(), std::size_t(10));
  QVERIFY(grid == cm::Mesh(grid) && grid != cm::make_grid(4, 3));
  QCOMPARE(cm::make_line(5).object_dimension(), 1);
  QVERIFY(!cm::make_cloth(3, 3).triangles().empty() && !cm::make_cloth(3, 3).is_grid());
  QCOMPARE(cm::make_cloth(3, 3, {.space_dimension = 3}).space_dimension(), 3);
  QCOMPARE(cm::make_block(2, 3, 4).element_count(), 24u);
  QCOMPARE(organ().tetrahedra().size(), std::size_t(6 * 12));
  QCOMPARE(std::string(cm::version()).find('.'), std::size_t(1));
}

void ApiTest::arrays_make_a_mesh() {
  const cm::Mesh made = organ();
  std::vector<cm::ElementId> cells;
  for (const auto& cell : made.tetrahedra()) {
    cells.insert(cells.end(), cell.begin(), cell.end());
  }
  const std::vector<double> positions = made.rest_positions();
  const cm::Mesh mesh = cm::make_mesh({.positions = positions, .tetrahedra = cells});
  QVERIFY(same_numbers(mesh.rest_positions(), positions));
  QCOMPARE(mesh.link_count(), made.link_count());
  QVERIFY(std::ranges::equal(mesh.tetrahedra(), made.tetrahedra()));
  QCOMPARE(mesh.object_dimension(), 3);

  const std::vector<double> chain{0, 5, 0, 1, 5, 0, 3, 5, 0};
  const std::vector<cm::ElementId> links{2, 1, 0, 1};
  const cm::Mesh line = cm::make_mesh({.positions = chain, .links = links});
  QCOMPARE(line.space_dimension(), 1);
  QCOMPARE(line.rest_length(1), 2.0);
  QVERIFY((line.rest_position(2) == cm::Vector3{3, 5, 0}));
  QCOMPARE(cm::make_mesh({.positions = chain, .links = links, .space_dimension = 2}).space_dimension(), 2);

  std::vector<double> millions(7'500'000);  // x, y and z
  millions[3] = 1;
  QCOMPARE(cm::make_mesh({.positions = millions, .links = links}).element_count(), 2'500'000U);
}

void ApiTest::bad_arrays_are_refused_data() {
  QTest::addColumn<std::vector<double>>("positions");
  QTest::addColumn<std::vector<cm::ElementId>>("links");
  QTest::addColumn<std::vector<cm::ElementId>>("triangles");
  QTest::addColumn<std::string>("reason");
  using Ids = std::vector<cm::ElementId>;
  const std::vector<double> three{0, 0, 0, 1, 0, 0, 0, 1, 0};
  const auto row = [](const char* name, const std::vector<double>& positions, const Ids& links, const Ids& triangles,
                      const std::string& reason) { QTest::newRow(name) << positions << links << triangles << reason; };
  row("nothing", {}, {}, {}, "there are 0 numbers");
  row("not whole points", {0, 0, 0, 1}, {0, 1}, {}, "there are 4 numbers");
  row("NaN", {0, 0, 0, no_number, 0, 0}, {0, 1}, {}, "positions, element 1");
  row("infinite", {0, 0, 0, 0, 0, std::numeric_limits<double>::infinity()}, {0, 1}, {}, "positions, element 1");
  row("no link", three, {}, {}, "there is no link");
  row("half a link", three, {0, 1, 2}, {}, "there are 3 ids");
  row("beyond the end", three, {0, 3}, {}, "uses element 3");
  row("to itself", three, {0, 1, 2, 2}, {}, "number 1 uses an element twice");
  row("a corner twice", three, {}, {0, 1, 1}, "number 0 uses an element twice");
  row("a face twice", three, {}, {0, 1, 2, 2, 1, 0}, "1 are there twice");
}

void ApiTest::bad_arrays_are_refused() {
  QFETCH(std::vector<double>, positions);
  QFETCH(std::vector<cm::ElementId>, links);
  QFETCH(std::vector<cm::ElementId>, triangles);
  QFETCH(std::string, reason);
  const std::string refusal =
      refusal_of([&] { cm::make_mesh({.positions = positions, .links = links, .triangles = triangles}); });
  QVERIFY2(has(refusal, reason), refusal.c_str());
}

void ApiTest::bad_meshes_are_refused() {
  const cm::Mesh grid = cm::make_grid(3, 3);
  QVERIFY(!refusal_of([] { cm::make_grid(0, 3); }).empty());
  QVERIFY(!refusal_of([] { cm::make_block(10'000, 10'000, 10'000); }).empty());
  QVERIFY(!refusal_of([] { cm::make_line(3, {.spacing = no_number}); }).empty());
  QVERIFY(!refusal_of([] { cm::make_block(2, 2, 2, {.space_dimension = 2}); }).empty());
  QVERIFY(has(refusal_of([&] { grid.neighbours(9); }), "element 9"));
  QVERIFY(has(refusal_of([&] { grid.rest_position(9); }), "element 9"));
  QVERIFY(has(refusal_of([&] { (void)grid.find_link(0, 9); }), "element 9"));
  QVERIFY(has(refusal_of([&] { grid.link(12); }), "link 12"));
  QVERIFY(has(refusal_of([&] { (void)grid.rest_length(12); }), "link 12"));
  QVERIFY(has(refusal_of([&] { grid.side("upper"); }), "use left, right"));
  QVERIFY(has(refusal_of([&] { grid.side("front"); }), "does not extend along that axis"));
}

void ApiTest::foreign_files_are_read() {
  const cm::Mesh mesh = cm::read_mesh(source_file("meshes/organ.msh"));
  QCOMPARE(mesh.object_dimension(), 3);
  const auto formats = cm::file_formats();
  const auto gmsh = std::ranges::find(formats, "Gmsh", &cm::FileFormat::name);
  QVERIFY(gmsh != formats.end() && gmsh->reads && gmsh->writes && gmsh->endings == ".msh");
  // Dense voxels have stiffer links, and a body of the mesh has them.
  const cm::Mesh voxels = cm::read_mesh(source_file("meshes/phantom.nrrd"), {.every = 4});
  QVERIFY(has(voxels.remark(), "voxels from a density of"));
  const cm::Body body(voxels);
  bool differs = false;
  for (cm::LinkId link = 0; link < voxels.link_count(); ++link) {
    differs |= body.softness(link) != body.softness();
  }
  QVERIFY(differs);
}

void ApiTest::bad_files_are_refused() {
  const QTemporaryDir folder;
  const std::filesystem::path path = folder.path().toStdString();
  QVERIFY(has(refusal_of([&] { cm::read_mesh(path / "none.obj"); }), "none.obj"));
  std::ofstream(path / "bad.obj") << "v 0 0 0\nv 1 0\nf 1 2 3\n";
  QVERIFY(has(refusal_of([&] { cm::read_mesh(path / "bad.obj"); }), "bad.obj:2"));
  const cm::Mesh grid = cm::make_grid(3, 3);
  QVERIFY(!refusal_of([&] { cm::write_mesh(path / "mesh.doc", grid); }).empty());
  QVERIFY(!refusal_of([&] { cm::write_mesh(path / "none" / "mesh.obj", grid); }).empty());
  const cm::Job cancelled;
  cancelled.cancel();
  QVERIFY_EXCEPTION_THROWN(cm::read_mesh(source_file("meshes/sphere.obj"), {}, cancelled), cm::Cancelled);
}

void ApiTest::positions_go_in_and_out() {
  for (const cm::Precision precision : {cm::Precision::single_precision, cm::Precision::double_precision}) {
    cm::Body body(cm::make_grid(4, 3), precision);
    QVERIFY(body.precision() == precision);
    std::vector<double> positions = body.mesh().rest_positions();
    QVERIFY(same_numbers(body.positions(), positions));
    for (std::size_t i = 0; i < positions.size(); ++i) {
      positions[i] += i % 3 == 2 ? 0 : 0.5 * double(i);
    }
    body.set_positions(positions);
    QVERIFY(same_numbers(body.positions(), positions));
    QVERIFY((body.position(3) == cm::Vector3{positions[9], positions[10], 0}));
    std::vector<double> copied(positions.size());
    body.copy_positions(copied);
    QVERIFY(same_numbers(copied, positions));
    body.reset();
    QVERIFY(same_numbers(body.positions(), body.mesh().rest_positions()));
  }
}

void ApiTest::bodies_are_independent() {
  cm::Body body(cm::make_grid(5, 5));
  body.pin({24});
  body.cut(0, 1);
  body.set_softness({.compression = 0.7, .stretch = 1.1, .shear = 0.2, .lateral = 0.3, .stiffness = 4, .exponent = -2});
  body.set_softness({0, 3}, {.compression = 1, .stretch = 1, .shear = 0});
  body.set_elasticity({.young = 2, .poisson = 0.4, .control_points = {3, 3, 3}});
  cm::Body copy = body;
  QVERIFY(State(copy) == State(body));
  const State before(body);
  copy.unpin({24});
  copy.uncut({0});
  copy.clear_softness({0, 3});
  copy.set_softness({});
  copy.set_elasticity({});
  copy.set_positions(std::vector<double>(75, 0.0));
  QVERIFY(State(body) == before);
  QVERIFY(State(copy) != before && copy.pins().empty() && copy.cuts().empty());
  copy = body;
  QVERIFY(State(copy) == before);
  const cm::Body moved = std::move(copy);
  QVERIFY(State(moved) == before);
}

void ApiTest::a_frame_turns_the_regions() {
  cm::Body body(cm::make_grid(5, 4));
  QVERIFY(body.frame() == cm::Rotation());
  body.set_frame({{0, 0, 2}, 30});
  QVERIFY(std::abs(body.frame().degrees - 30) < 1e-12 && std::abs(body.frame().axis.z - 1) < 1e-12);
  const std::vector<double> at = body.positions(), rest = body.mesh().rest_positions();
  for (std::size_t i = 0; i < at.size(); ++i) {
    QVERIFY(std::abs(at[i] - rest[i]) < 1e-14);
  }
  QVERIFY(cm::Body(body).frame() == body.frame());
  QVERIFY(has(refusal_of([&] { body.set_frame({{1, 0, 0}, 30}); }), "rotation"));
  QVERIFY(has(refusal_of([&] { body.set_frame({{0, 0, 0}, 30}); }), "rotation"));
  QVERIFY(std::abs(body.frame().degrees - 30) < 1e-12);
  cm::Deformer turned(body, "exact"), plain(cm::Body(body.mesh()), "exact");
  turned.move(19, {6, 5, 0});
  plain.move(19, {6, 5, 0});
  QVERIFY(!same_numbers(turned.body().positions(), plain.body().positions()));
  QVERIFY(cm::violation(turned.body()).max < 1e-12);
  QVERIFY((turned.body().position(19) == cm::Vector3{6, 5, 0}) || std::abs(turned.body().position(19).x - 6) < 1e-12);
  QVERIFY(body.set_frame_of_object());
  QVERIFY(body.frame() == cm::Rotation());
  QVERIFY(!cm::Body(cm::make_grid(4, 4)).set_frame_of_object());
}

void ApiTest::bad_input_of_a_body_changes_nothing() {
  cm::Body body(cm::make_grid(3, 3), cm::Precision::single_precision);
  body.pin({8});
  body.cut({2});
  const State before(body);
  const auto refused = [&](auto act, const std::string& reason) {
    const std::string refusal = refusal_of(act);
    QVERIFY2(has(refusal, reason), refusal.c_str());
    QVERIFY2(State(body) == before, reason.c_str());
  };
  const auto with = [&](std::size_t at, double value) {
    std::vector<double> positions = body.mesh().rest_positions();
    positions[at] = value;
    return positions;
  };
  refused([&] { body.set_positions(std::vector<double>(26)); }, "there are 26 numbers for 9 elements");
  refused([&] { body.set_positions(with(4, no_number)); }, "positions, element 1");
  refused([&] { body.set_positions(with(25, 1e38)); }, "positions, element 8");
  refused([&] { body.set_positions(with(5, 1)); }, "does not extend along z");
  refused(
      [&] {
        std::vector<double> small(3);
        body.copy_positions(small);
      },
      "use one of 27");
  refused([&] { (void)body.position(9); }, "element 9");
  refused([&] { body.pin({0, 9}); }, "element 9");
  refused([&] { body.unpin({8, 9}); }, "element 9");
  refused([&] { (void)body.is_pinned(9); }, "element 9");
  refused([&] { body.cut({0, 12}); }, "link 12");
  refused([&] { body.cut(0, 8); }, "not linked");
  refused([&] { body.cut(0, 9); }, "element 9");
  refused([&] { body.uncut({2, 12}); }, "link 12");
  refused([&] { (void)body.is_cut(12); }, "link 12");
  refused([&] { body.set_softness({.compression = 1.1}); }, "compression");
  refused([&] { body.set_softness({.shear = no_number}); }, "shear");
  refused([&] { body.set_softness({0, 12}, {}); }, "link 12");
  refused([&] { body.set_softness({0}, {.stretch = 0.9}); }, "stretch");
  refused([&] { body.set_softness({.lateral = -0.1}); }, "lateral");
  refused([&] { body.set_softness({.stiffness = 0}); }, "stiffness");
  refused([&] { body.set_softness({0}, {.exponent = 4.1}); }, "exponent");
  refused([&] { body.clear_softness({12}); }, "link 12");
  refused([&] { (void)body.softness(12); }, "link 12");
  refused([&] { body.set_elasticity({.poisson = 0.5}); }, "poisson");
}

CHAINMAIL_TEST(ApiTest)

}  // namespace chainmail::test_api

#include "test_api.moc"
