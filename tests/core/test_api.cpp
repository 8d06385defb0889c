#include <chainmail/chainmail.h>

#include <QTemporaryDir>
#include <QtTest>
#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "calibrate/calibrate.h"
#include "core/allocations.h"
#include "measure/distance.h"
#include "measure/physical_error.h"
#include "measure/violation.h"
#include "mesh/generate.h"
#include "mesh/layers.h"
#include "simulate/simulation.h"
#include "solve/solver.h"

namespace cm = chainmail::api;
using chainmail::Algorithm;
using chainmail::AlgorithmInfo;
using chainmail::MeshKind;
using chainmail::MeshPointer;
using chainmail::Point;
using chainmail::Solver;

/// The public interface: what goes in comes out, it computes what core computes, and bad input changes nothing.
class ApiTest : public QObject {
  Q_OBJECT

 private slots:
  void a_mesh_states_its_facts();
  void arrays_make_a_mesh();
  void bad_arrays_are_refused_data();
  void bad_arrays_are_refused();
  void bad_meshes_are_refused();
  void files_are_written_and_read_data();
  void files_are_written_and_read();
  void foreign_files_are_read();
  void bad_files_are_refused();
  void positions_go_in_and_out();
  void a_snapshot_restores_every_bit();
  void bodies_are_independent();
  void links_are_cut_and_soft();
  void bad_input_of_a_body_changes_nothing();
  void methods_are_those_of_the_table();
  void moves_equal_those_of_the_solver_data();
  void moves_equal_those_of_the_solver();
  void a_copied_body_continues_alike();
  void relaxation_equals_that_of_a_simulation();
  void the_equilibrium_is_certified();
  void moves_are_traced();
  void control_points_move();
  void a_handle_of_many_moves_as_one();
  void bad_moves_change_nothing();
  void a_move_allocates_nothing();
  void one_call_deforms();
  void measures_are_those_of_core();
  void the_reference_solution_is_that_of_core();
  void bad_measures_are_refused();
  void jobs_are_cancelled();
  void methods_are_compared();
  void many_elements_are_compared();
  void methods_are_compared_with_physics();
  void bad_comparisons_are_refused();
  void softness_is_calibrated();
  void bad_calibrations_are_refused();
  void an_own_method_is_listed_and_moves();
  void an_own_method_is_compared();
  void an_own_method_that_throws_moves_nothing();
  void an_own_method_cannot_move_what_is_fixed();
  void bad_registrations_are_refused();
};

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// Returns the message of the error that an act throws. It must be one sentence: where, what, what to do.
template <class Act>
std::string refusal_of(Act act) {
  try {
    act();
  } catch (const cm::Error& error) {
    const std::string text = error.what();
    const bool is_sentence = !error.where().empty() && !error.problem().empty() && !error.remedy().empty() &&
                             text == error.where() + ": " + error.problem() + "; " + error.remedy() &&
                             text.find('\n') == std::string::npos;
    return is_sentence ? text : "not a sentence: " + text;
  }
  return "";
}

bool has(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

bool same_numbers(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

/// The positions of a solver, x, y, z for each element.
std::vector<double> positions_of(const Solver& solver) {
  std::vector<double> all;
  for (chainmail::ElementId e = 0; e < solver.body().mesh().element_count(); ++e) {
    const Point point = point_of(solver.body().mesh(), solver.body().positions(), e);
    all.insert(all.end(), point.begin(), point.end());
  }
  return all;
}

cm::Mesh organ() { return cm::make_tetra(4, 3, 3); }
MeshPointer inner_organ() { return chainmail::generate({MeshKind::tetra, {4, 3, 3}}); }

/// What a body contains, to see whether something changed.
struct State {
  explicit State(const cm::Body& body)
      : positions(body.positions()),
        cuts(body.cuts()),
        pins(body.pins().begin(), body.pins().end()),
        softness(body.softness()),
        first(body.softness(0)),
        elasticity(body.elasticity()) {}
  bool operator==(const State&) const = default;

  std::vector<double> positions;
  std::vector<cm::LinkId> cuts;
  std::vector<cm::ElementId> pins;
  cm::LinkSoftness softness, first;
  cm::Elasticity elasticity;
};

/// Natural Queue ChainMail, written for the public interface.
class OwnQueue : public cm::Method {
 public:
  std::uint64_t move(cm::MovingBody& body, const cm::HandleMove& move) override {
    std::vector<bool> is_queued(body.mesh().element_count(), false);
    std::vector<cm::ElementId> queue(move.elements.begin(), move.elements.end());
    std::uint64_t checked = 0;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const auto found = body.neighbours(queue[i]);
      const std::vector<cm::ElementId> neighbours(found.begin(), found.end());
      for (const cm::ElementId element : neighbours) {
        if (!body.is_fixed(element) && !is_queued[element]) {
          is_queued[element] = true;
          ++checked;
          if (step(body, element, queue[i])) {
            queue.push_back(element);
          }
        }
      }
    }
    return checked;
  }

 protected:
  virtual bool step(cm::MovingBody& body, cm::ElementId element, cm::ElementId sponsor) {
    return body.clamp(element, sponsor);
  }
};

/// The same, with the box of the valid region.
class BoxQueue : public OwnQueue {
  bool step(cm::MovingBody& body, cm::ElementId element, cm::ElementId sponsor) override {
    const cm::Box box = body.valid_region(sponsor, element);
    const cm::Vector3 before = body.position(element);
    const cm::Vector3 after{std::clamp(before.x, box.low.x, box.high.x), std::clamp(before.y, box.low.y, box.high.y),
                            std::clamp(before.z, box.low.z, box.high.z)};
    body.set_position(element, after);
    return before != after;
  }
};

/// Moves elements, then fails in a way that the test chooses.
class Failing : public cm::Method {
 public:
  explicit Failing(std::function<void(cm::MovingBody&)> fail) : fail_(std::move(fail)) {}
  std::uint64_t move(cm::MovingBody& body, const cm::HandleMove&) override {
    body.set_position(8, {7, 7, 0});
    body.set_position(7, {1, 2.5, 0});
    body.set_position(7, {1, 3, 0});
    fail_(body);
    return 2;
  }

 private:
  std::function<void(cm::MovingBody&)> fail_;
};

bool is_known(const std::string& name) {
  const auto all = cm::methods();
  return std::ranges::any_of(all, [&](const cm::MethodInfo& one) { return one.name == name; });
}

void register_own_methods() {
  if (!is_known("own-queue")) {
    cm::register_method(
        {.name = "own-queue", .label = "Own queue", .source = "a test", .summary = "like Natural Queue"},
        [] { return std::make_unique<OwnQueue>(); });
    cm::register_method({.name = "own-boxes"}, [] { return std::make_unique<BoxQueue>(); });
  }
}

}  // namespace

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

void ApiTest::files_are_written_and_read_data() {
  QTest::addColumn<QString>("ending");
  for (const char* ending : {".obj", ".ply", ".msh"}) {
    QTest::newRow(ending) << QString(ending);
  }
}

void ApiTest::files_are_written_and_read() {
  QFETCH(QString, ending);
  const QTemporaryDir folder;
  const std::filesystem::path path = folder.filePath("mesh" + ending).toStdString();
  cm::Deformer deformer(cm::make_cloth(5, 4), "natural-queue");
  deformer.move(0, {-2.25, 1.5, 0});
  cm::write_mesh(path, deformer.body());
  const cm::Mesh read = cm::read_mesh(path);
  QVERIFY(same_numbers(read.rest_positions(), deformer.body().positions()));
  QCOMPARE(read.link_count(), deformer.body().mesh().link_count());
  cm::write_mesh(path, deformer.body().mesh());
  QVERIFY(same_numbers(cm::read_mesh(path).rest_positions(), deformer.body().mesh().rest_positions()));
}

void ApiTest::foreign_files_are_read() {
  const cm::Mesh mesh = cm::read_mesh(PROJECT_SOURCE_DIR "/meshes/organ.msh");
  QCOMPARE(mesh.object_dimension(), 3);
  const auto formats = cm::file_formats();
  const auto gmsh = std::ranges::find(formats, "Gmsh", &cm::FileFormat::name);
  QVERIFY(gmsh != formats.end() && gmsh->reads && gmsh->writes && gmsh->endings == ".msh");
  // Dense voxels have stiffer links, and a body of the mesh has them.
  const cm::Mesh voxels = cm::read_mesh(PROJECT_SOURCE_DIR "/meshes/phantom.nrrd", {.every = 4});
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
  QVERIFY_EXCEPTION_THROWN(cm::read_mesh(PROJECT_SOURCE_DIR "/meshes/sphere.obj", {}, cancelled), cm::Cancelled);
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

void ApiTest::a_snapshot_restores_every_bit() {
  for (const char* method : {"natural-queue", "exact"}) {
    cm::Deformer deformer(cm::make_cloth(9, 9), method, cm::Precision::single_precision);
    const cm::Snapshot rest = deformer.body().snapshot();
    deformer.move(0, {-3.1, 0.7, 0});
    const cm::Snapshot moved = deformer.body().snapshot();
    const std::vector<double> positions = deformer.body().positions();
    deformer.move(0, {-7.9, 5.3, 0});
    QVERIFY(!same_numbers(deformer.body().positions(), positions));
    deformer.body().restore(moved);
    QVERIFY(same_numbers(deformer.body().positions(), positions));
    QVERIFY(deformer.body().snapshot() == moved && moved != rest);
    deformer.body().restore(rest);
    QVERIFY(same_numbers(deformer.body().positions(), deformer.body().mesh().rest_positions()));
    cm::Body other(cm::make_cloth(9, 9), cm::Precision::single_precision), finer(deformer.body().mesh());
    QVERIFY(has(refusal_of([&] { other.restore(moved); }), "another mesh or precision"));
    QVERIFY(has(refusal_of([&] { finer.restore(moved); }), "another mesh or precision"));
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

void ApiTest::links_are_cut_and_soft() {
  cm::Body body(cm::make_line(4));
  body.cut(1, 2);
  QVERIFY(body.is_cut(1) && !body.is_cut(0) && body.cuts() == std::vector<cm::LinkId>{1});
  cm::Deformer deformer(body, "natural-queue");
  QCOMPARE(deformer.move(0, {-5, 0, 0}).moved, std::uint64_t(1));
  deformer.body().reset();
  deformer.body().uncut({1});
  QCOMPARE(deformer.move(0, {-5, 0, 0}).moved, std::uint64_t(3));
  deformer.body().reset();
  deformer.body().pin({2});
  QVERIFY(deformer.body().is_pinned(2) && !deformer.body().is_pinned(1));
  QCOMPARE(deformer.move(0, {-5, 0, 0}).moved, std::uint64_t(1));
  deformer.body().unpin({2});
  deformer.body().reset();
  deformer.body().set_softness({1, 1}, {.compression = 0, .stretch = 100, .shear = 0});
  QCOMPARE(deformer.body().softness(1).stretch, 100.0);
  QCOMPARE(deformer.body().softness(0), deformer.body().softness());
  QCOMPARE(deformer.move(0, {-5, 0, 0}).moved, std::uint64_t(1));
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

void ApiTest::methods_are_those_of_the_table() {
  const auto all = cm::methods();
  QCOMPARE(all.size(), chainmail::every_algorithm().size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const AlgorithmInfo& one = chainmail::every_algorithm()[i];
    QCOMPARE(all[i].name, std::string(one.offered_name()));
    QCOMPARE(all[i].label, std::string(one.label));
    QCOMPARE(all[i].source, std::string(one.source));
    QCOMPARE(all[i].needs_pins, one.needs_pins);
    QCOMPARE(all[i].needs_grid, one.needs_grid);
    QVERIFY((all[i].family == cm::MethodFamily::elastic) == one.elastic.has_value());
  }
  QVERIFY(cm::method_info("exact").holds_links && !cm::method_info("exact").is_registered);
  QVERIFY(has(refusal_of([] { cm::method_info("magic"); }), "use one of generalized, spiral"));
  QVERIFY(has(cm::refusal("3d", cm::make_cloth(3, 3)), "only on grids"));
  QVERIFY(cm::refusal("3d", cm::make_grid(3, 3)).empty());
  QVERIFY(has(refusal_of([] { (void)cm::refusal("magic", cm::make_grid(3, 3)); }), "magic"));
}

void ApiTest::moves_equal_those_of_the_solver_data() {
  QTest::addColumn<std::string>("method");
  QTest::addColumn<cm::Precision>("precision");
  for (const AlgorithmInfo& one : chainmail::every_algorithm()) {
    if (one.texts == nullptr) {
      QTest::addRow("%s, float", one.name.data()) << std::string(one.name) << cm::Precision::single_precision;
      QTest::addRow("%s, double", one.name.data()) << std::string(one.name) << cm::Precision::double_precision;
    }
  }
}

/// One element, then many with a rotation, on a mesh with pins, cuts and a stiff link.
void ApiTest::moves_equal_those_of_the_solver() {
  QFETCH(std::string, method);
  QFETCH(cm::Precision, precision);
  const auto algorithm = *chainmail::find_algorithm(method);
  const bool is_grid = chainmail::info(algorithm).needs_grid;
  const MeshPointer mesh =
      is_grid ? chainmail::generate({MeshKind::block, {5, 4, 3}}) : chainmail::generate({MeshKind::tetra, {5, 4, 3}});
  const auto solver =
      make_solver(mesh, algorithm,
                  precision == cm::Precision::single_precision ? chainmail::Precision::single_precision
                                                               : chainmail::Precision::double_precision);
  cm::Deformer deformer(is_grid ? cm::make_block(5, 4, 3) : cm::make_tetra(5, 4, 3), method, precision);
  const std::vector<cm::ElementId> pins = deformer.body().mesh().side("left");
  deformer.body().pin(pins);
  solver->body().pin(pins);
  deformer.body().set_softness({.compression = 0.7, .stretch = 1.3, .shear = 0.05});
  deformer.body().set_softness({7}, {.compression = 1, .stretch = 1, .shear = 0});
  chainmail::Softness softness{{0.7, 1.3, 0.05}, {{7, {1, 1, 0}}}};
  solver->body().set_softness(softness);

  const cm::ElementId tip = 34;
  for (const double by : {0.3, 0.9, -0.4}) {
    const cm::Vector3 rest = deformer.body().mesh().rest_position(tip);
    const cm::MoveResult result = deformer.move(tip, rest + cm::Vector3{by, 0.5 * by, 0.1});
    const auto count = solver->move(tip, Point(rest.x + by, rest.y + 0.5 * by, rest.z + 0.1));
    QCOMPARE(result.moved, count.moved);
    QCOMPARE(result.checked, count.checked);
    QVERIFY(same_numbers(deformer.body().positions(), positions_of(*solver)));
    QVERIFY(std::ranges::equal(deformer.moved(), solver->moved()));
  }
  deformer.body().cut({20});
  solver->body().cut(std::vector<chainmail::LinkId>{20});
  const std::vector<cm::ElementId> right = deformer.body().mesh().side("right");
  cm::Handle handle = deformer.grab(right);
  chainmail::Handle inner(solver->body(), right);
  for (const double step : {0.5, 1.0}) {
    const chainmail::Rotation rotation{Point(1, 0, 0), 20 * step};
    const cm::Motion motion{{0.4 * step, 0, 0.1}, {{1, 0, 0}, 20 * step}};
    const cm::MoveResult result = deformer.move(handle, handle.after(motion));
    const auto count = solver->move(inner, {inner.grabbed().pivot + Point(0.4 * step, 0, 0.1), rotation.vector()});
    QCOMPARE(result.moved, count.moved);
    QCOMPARE(result.stopped, count.stopped);
    QCOMPARE(result.remark, solver->remark());
    QVERIFY(same_numbers(deformer.body().positions(), positions_of(*solver)));
  }
}

/// Exact ChainMail stores displacements, the others positions; a copy stores the same numbers.
void ApiTest::a_copied_body_continues_alike() {
  for (const char* method : {"natural-queue", "exact"}) {
    cm::Deformer first(cm::make_cloth(7, 6), method, cm::Precision::single_precision);
    first.move(0, {-2.7, 0.3, 0});
    cm::Deformer second(first.body(), method);
    QVERIFY(same_numbers(second.body().positions(), first.body().positions()));
    for (const double x : {-3.9, -8.1}) {
      first.move(0, {x, 1.1, 0});
      second.move(0, {x, 1.1, 0});
      QVERIFY(same_numbers(second.body().positions(), first.body().positions()));
    }
    second.set_method("spiral");
    QCOMPARE(second.method(), std::string("spiral"));
    second.move(0, {-9, 0, 0});
    QVERIFY(!same_numbers(second.body().positions(), first.body().positions()));
  }
}

void ApiTest::relaxation_equals_that_of_a_simulation() {
  for (const cm::RelaxationScheme scheme : {cm::RelaxationScheme::mean, cm::RelaxationScheme::link}) {
    cm::Deformer deformer(cm::make_grid(8, 8), "natural-queue");
    chainmail::Simulation simulation(chainmail::generate({MeshKind::grid, {8, 8, 1}}), Algorithm::natural_queue,
                                     chainmail::Precision::double_precision);
    simulation.apply(chainmail::commands::SetRelaxation{
        false, 0.8,
        scheme == cm::RelaxationScheme::mean ? chainmail::RelaxationScheme::mean : chainmail::RelaxationScheme::link});
    simulation.apply(chainmail::commands::Grab{0});
    for (const double x : {-1.0, -4.0}) {
      deformer.move(0, {x, -2, 0});
      QCOMPARE(deformer.relax(3, {.step = 0.8, .scheme = scheme}), 3);
      simulation.apply(chainmail::commands::Drag{Point(x, -2, 0)});
      simulation.relax(3, 0.8);
      QVERIFY(same_numbers(deformer.body().positions(), positions_of(simulation.solver())));
    }
    deformer.release();
    simulation.apply(chainmail::commands::Release{});
    QVERIFY(deformer.relax(5, {.scheme = scheme}) > 0);
    simulation.relax(5, 1);
    QVERIFY(same_numbers(deformer.body().positions(), positions_of(simulation.solver())));
    QVERIFY((deformer.body().position(0) != cm::Vector3{-4, -2, 0}));  // it was released
    deformer.body().reset();
    QCOMPARE(deformer.relax(2), 0);  // nothing has moved since
  }
  cm::Deformer elastic(organ(), "fem");
  QCOMPARE(elastic.relax(3), 0);
}

void ApiTest::the_equilibrium_is_certified() {
  cm::Deformer deformer(cm::make_grid(8, 8), "natural-queue");
  QCOMPARE(deformer.certificate().iterations, 0);
  deformer.body().pin({0});
  deformer.move(63, {9, 8, 0});
  const int close = deformer.relax(200, {.scheme = cm::RelaxationScheme::equilibrium});
  QVERIFY(close > 1 && close < 200);
  const cm::EquilibriumCertificate found = deformer.certificate();
  QCOMPARE(found.iterations, close);
  QVERIFY(found.residual <= 1e-3 && found.violation < 1e-9 && (!found.energy_gap || *found.energy_gap >= 0));
  QVERIFY((deformer.body().position(63) == cm::Vector3{9, 8, 0}));
  QCOMPARE(deformer.relax(7, {.scheme = cm::RelaxationScheme::equilibrium, .until = 0}), 7);
  QVERIFY(deformer.certificate().residual < found.residual);
}

void ApiTest::moves_are_traced() {
  cm::Deformer deformer(cm::make_grid(4, 4), "natural-queue");
  deformer.move(0, {-2, 0, 0});
  QVERIFY(deformer.trace().empty());
  deformer.set_tracing(true);
  const auto solver = make_solver(chainmail::generate({MeshKind::grid, {4, 4, 1}}), Algorithm::natural_queue,
                                  chainmail::Precision::double_precision);
  solver->move(0, Point(-2, 0, 0));
  chainmail::Trace trace;
  const auto result = deformer.move(0, {-5, 1, 0});
  solver->move(0, Point(-5, 1, 0), &trace);
  QCOMPARE(deformer.trace().size(), trace.size());
  QCOMPARE(deformer.trace().size(), std::size_t(result.checked));
  for (std::size_t i = 0; i < trace.size(); ++i) {
    QCOMPARE(deformer.trace()[i].element, trace[i].element);
    QCOMPARE(deformer.trace()[i].sponsor, trace[i].sponsor);
    QCOMPARE(deformer.trace()[i].moved, trace[i].moved);
  }
  deformer.set_tracing(false);
  deformer.move(0, {-6, 1, 0});
  QVERIFY(deformer.trace().empty());
}

void ApiTest::control_points_move() {
  cm::Deformer deformer(cm::make_cloth(5, 5), "ffd");
  const std::vector<double> points = deformer.control_points();
  QCOMPARE(points.size(), std::size_t(3 * 16));
  deformer.move_control_point(0, {-3, 0, 0});
  QCOMPARE(deformer.control_points()[0], -3.0);
  QVERIFY(!same_numbers(deformer.body().positions(), deformer.body().mesh().rest_positions()));
  QVERIFY(has(refusal_of([&] { deformer.move_control_point(16, {}); }), "control point 16"));
  QVERIFY(has(refusal_of([&] { deformer.move_control_point(0, {no_number, 0, 0}); }), "not a finite number"));
  QVERIFY(cm::Deformer(cm::make_cloth(5, 5), "exact").control_points().empty());
}

void ApiTest::a_handle_of_many_moves_as_one() {
  cm::Deformer deformer(cm::make_grid(6, 6), "natural-queue");
  cm::Handle handle = deformer.grab({7, 0, 1, 6});
  QVERIFY(std::ranges::equal(handle.elements(), std::vector<cm::ElementId>{0, 1, 6, 7}));
  QVERIFY((handle.grabbed() == cm::Pose{{0.5, 0.5, 0}, {}}) && handle.pose() == handle.grabbed());
  const cm::MoveResult result = deformer.move(handle, handle.after({{-4, 0, 0}, {{0, 0, 2}, 90}}));
  QVERIFY(result.moved > 0 && result.reached == handle.pose());
  QVERIFY((handle.pose().pivot == cm::Vector3{-3.5, 0.5, 0}));
  QVERIFY(std::abs(handle.pose().rotation.degrees - 90) < 1e-12);
  QVERIFY((handle.pose().rotation.axis == cm::Vector3{0, 0, 1}));
  // Element 0, at (-0.5, -0.5) from the pivot, turns to (0.5, -0.5).
  const cm::Vector3 at = deformer.body().position(0);
  QVERIFY(std::abs(at.x - -3) < 1e-12 && std::abs(at.y - 0) < 1e-12);
  cm::Handle copy = handle;
  QVERIFY(copy.pose() == handle.pose());
  deformer.move(copy, copy.grabbed());
  QVERIFY(copy.pose() != handle.pose());
  QVERIFY(std::abs(deformer.body().position(7).x - 1) < 1e-12);
}

void ApiTest::bad_moves_change_nothing() {
  cm::Deformer deformer(cm::make_grid(4, 4), "exact", cm::Precision::single_precision);
  deformer.body().pin({15});
  deformer.move(0, {-0.5, 0, 0});
  cm::Handle handle = deformer.grab({0, 1}), pinned = handle;
  const cm::Deformer other(cm::make_grid(4, 4), "exact");
  cm::Handle foreign = other.grab({0, 1});
  const State before(deformer.body());
  const auto refused = [&](auto act, const std::string& reason) {
    const std::string refusal = refusal_of(act);
    QVERIFY2(has(refusal, reason), refusal.c_str());
    QVERIFY2(State(deformer.body()) == before, reason.c_str());
    QCOMPARE(deformer.method(), std::string("exact"));
  };
  refused([] { cm::Deformer(cm::make_grid(2, 2), "magic"); }, "there is no such method");
  refused([] { cm::Deformer(cm::make_cloth(2, 2), "3d"); }, "only on grids");
  refused([&] { deformer.set_method("magic"); }, "there is no such method");
  refused([&] { deformer.set_method("bem"); }, "");
  refused([&] { deformer.move(16, {}); }, "element 16");
  refused([&] { deformer.move(15, {}); }, "it is pinned");
  refused([&] { deformer.move(0, {no_number, 0, 0}); }, "not a finite number");
  refused([&] { deformer.move(0, {1e38, 0, 0}); }, "out of the range of the precision");
  refused([&] { deformer.move(0, {0, 0, 1}); }, "does not extend along z");
  refused([&] { deformer.grab({}); }, "it has no elements");
  refused([&] { deformer.grab({0, 0}); }, "grabbed twice");
  refused([&] { deformer.grab({16}); }, "element 16");
  refused([&] { deformer.grab({15}); }, "pinned");
  refused([&] { deformer.move(foreign, foreign.grabbed()); }, "it is of another mesh");
  refused([&] { deformer.move(handle, {{0, no_number, 0}, {}}); }, "not a finite number");
  refused([&] { deformer.move(handle, handle.after({{}, {{0, 1, 0}, 10}})); }, "leave the space");
  refused([&] { deformer.move(handle, handle.after({{}, {{0, 0, 0}, 10}})); }, "no axis");
  refused([&] { deformer.move(handle, handle.after({{}, {{0, 0, 1}, no_number}})); }, "not a finite number");
  refused([&] { deformer.relax(-1); }, "below 0");
  refused([&] { deformer.relax(1, {.step = 0}); }, "relax-step");
  refused([&] { deformer.relax(1, {.until = 2}); }, "relax-until");
  QVERIFY(handle.pose() == pinned.pose());
}

void ApiTest::a_move_allocates_nothing() {
  for (const char* method : {"generalized", "natural-queue", "exact"}) {
    cm::Deformer deformer(cm::make_grid(20, 20), method);
    cm::Handle handle = deformer.grab({0});
    const auto drag = [&] {
      for (int step = 1; step <= 10; ++step) {
        deformer.move(handle, handle.after({{-0.7 * step, 0.2 * step, 0}, {}}));
      }
    };
    drag();
    drag();
    const auto before = chainmail::test::allocations.load();
    drag();
    QCOMPARE(chainmail::test::allocations.load(), before);
  }
}

void ApiTest::one_call_deforms() {
  cm::Deformer deformer(organ(), "natural-queue");
  cm::Handle handle = deformer.grab({0, 4});
  deformer.move(handle, handle.after({{-2, 0, 1}, {}}));
  QVERIFY(same_numbers(cm::deform(organ(), "natural-queue", {0, 4}, {-2, 0, 1}), deformer.body().positions()));
  QVERIFY(has(refusal_of([] { cm::deform(organ(), "natural-queue", {0}, {no_number, 0, 0}); }), "not a finite number"));
}

void ApiTest::measures_are_those_of_core() {
  cm::Deformer deformer(cm::make_cloth(8, 8), "generalized");
  const auto solver = make_solver(chainmail::generate({MeshKind::cloth, {8, 8, 1}}), Algorithm::generalized,
                                  chainmail::Precision::double_precision);
  deformer.body().cut({3});
  solver->body().cut(std::vector<chainmail::LinkId>{3});
  deformer.move(9, {-4, 6, 0});
  solver->move(9, Point(-4, 6, 0));
  const chainmail::Body& body = solver->body();
  const auto expected = measure_violation(body.mesh(), body.softness(), body.cuts(), body.positions());
  const cm::Violation found = cm::violation(deformer.body());
  QVERIFY(found.max > 0);
  QCOMPARE(found.max, expected.max);
  QCOMPARE(found.rms, expected.rms);
  QCOMPARE(found.fraction, expected.fraction);
  QCOMPARE(found.links, expected.links);
  QCOMPARE(cm::violation(deformer.body(), 20), link_violation(body.mesh(), body.softness(), body.positions(), 20));
  QCOMPARE(cm::displacement(deformer.body()).max, measure_displacement(body.mesh(), body.positions()).max);
  QCOMPARE(cm::elastic_energy(deformer.body()),
           chainmail::elastic_energy(body.mesh(), body.softness(), body.cuts(), body.positions()));
  QVERIFY(deformer.body().energy() == cm::EnergyKind::corotated);
  for (const auto kind : {chainmail::EnergyKind::isotropic, chainmail::EnergyKind::axial}) {
    cm::Body turned = deformer.body();
    turned.set_energy(static_cast<cm::EnergyKind>(kind));
    QVERIFY(turned.energy() == static_cast<cm::EnergyKind>(kind));
    chainmail::Softness softness = body.softness();
    set_energy(softness, kind);
    QCOMPARE(cm::elastic_energy(turned),
             chainmail::elastic_energy(body.mesh(), softness, body.cuts(), body.positions()));
  }
  const cm::Body rest(deformer.body().mesh());
  const cm::Spread apart = cm::distance(deformer.body(), rest);
  QCOMPARE(apart.max, cm::displacement(deformer.body()).max / deformer.body().mesh().mean_rest_length());
  QCOMPARE(cm::distance(deformer.body(), rest.positions()).rms, apart.rms);
}

void ApiTest::the_reference_solution_is_that_of_core() {
  cm::Body body(organ());
  body.pin(body.mesh().side("left"));
  body.set_elasticity({.poisson = 0.2});
  std::vector<double> positions = body.mesh().rest_positions();
  const cm::ElementId tip = body.mesh().side("right").back();
  positions[3 * tip + 1] += 0.5;
  body.set_positions(positions);
  const cm::ReferenceSolution found = cm::reference_solution(body, {tip});

  const MeshPointer mesh = inner_organ();
  const auto pins = layer(*mesh, *chainmail::find_side("left"));
  chainmail::ElasticProblem problem{mesh, chainmail::Cuts(mesh), pins, std::vector<double>(3 * pins.size()), {}};
  problem.options.material.poisson = 0.2;
  const auto expected = chainmail::ReferenceSolver(problem).at(tip, mesh->rest_position(tip) + Point(0, 0.5, 0));
  QCOMPARE(found.handle_displacement(), 0.5);
  const std::vector<double> reference = found.positions();
  for (std::size_t i = 0; i < reference.size(); ++i) {
    QVERIFY(std::abs(reference[i] - mesh->rest[i] - expected.displacements[i]) < 1e-12);
  }
  // Only the handle has moved so far.
  QVERIFY(std::abs(cm::physical_error(body, found).relative - cm::physical_error_of_rest(found).relative) < 1e-12);
  QVERIFY(cm::physical_error_of_rest(found).relative > 0.5);
  body.set_positions(reference);
  QVERIFY(cm::physical_error(body, found).max < 1e-12);
}

void ApiTest::bad_measures_are_refused() {
  cm::Body body(organ());
  const cm::Body other(organ());
  QVERIFY(has(refusal_of([&] { (void)cm::violation(body, 100'000); }), "link 100000"));
  QVERIFY(has(refusal_of([&] { cm::distance(body, other); }), "different meshes"));
  QVERIFY(has(refusal_of([&] { cm::distance(body, std::vector<double>(3)); }), "there are 3 numbers"));
  body.pin(body.mesh().side("left"));
  QVERIFY(has(refusal_of([&] { cm::reference_solution(body, {1}); }), "it is at rest"));
  QVERIFY(has(refusal_of([&] { cm::reference_solution(body, {0}); }), "pinned"));
  QVERIFY(has(refusal_of([&] { cm::reference_solution(body, {99}); }), "element 99"));
  std::vector<double> positions = body.mesh().rest_positions();
  positions[3] += 0.1;
  body.set_positions(positions);
  const auto reference = cm::reference_solution(body, {1});
  QVERIFY(has(refusal_of([&] { cm::physical_error(other, reference); }), "another mesh"));
  body.unpin(body.mesh().side("left"));
  QVERIFY(has(refusal_of([&] { cm::reference_solution(body, {1}); }), "nothing pins"));
}

void ApiTest::jobs_are_cancelled() {
  const cm::Job job;
  cm::Deformer deformer(organ(), "neo-hookean");
  deformer.body().pin(deformer.body().mesh().side("left"));
  deformer.set_job(job);
  deformer.move(3, {3.2, 0, 0});
  QVERIFY(!job.is_cancelled() && job.share() > 0);
  const State before(deformer.body());
  job.cancel();
  QVERIFY(job.is_cancelled());
  QVERIFY_EXCEPTION_THROWN(deformer.move(3, {3.6, 0.5, 0}), cm::Cancelled);
  QVERIFY(State(deformer.body()) == before);
  QVERIFY_EXCEPTION_THROWN(cm::compare(cm::Body(cm::make_grid(4, 4)), {}, {.repetitions = 1}, job), cm::Cancelled);
  QVERIFY_EXCEPTION_THROWN(cm::calibrate(deformer.body(), {}, job), cm::Cancelled);
  QVERIFY_EXCEPTION_THROWN(cm::reference_solution(deformer.body(), {3}, job), cm::Cancelled);
}

void ApiTest::methods_are_compared() {
  cm::Body body(cm::make_cloth(8, 8));
  body.cut({5});
  body.set_softness({.compression = 0.9, .stretch = 1.1, .shear = 0});
  body.set_softness({50, 51}, {.compression = 0.5, .stretch = 3, .shear = 1});
  const cm::Drag drag{.name = "pull <b>", .elements = {0}, .path = {{{-1, 0, 0}, {}}, {{-4, -2, 0}, {}}}};
  cm::CompareOptions options;
  options.title = "my sheet";
  options.methods = {"generalized", "exact", "3d"};
  options.sweeps = {0, 2};
  options.repetitions = 1;
  options.precision = cm::Precision::double_precision;
  const cm::Job job;
  const cm::Comparison comparison = cm::compare(body, {drag}, options, job);
  QCOMPARE(job.share(), 1.0);
  const auto& rows = comparison.rows();
  QCOMPARE(rows.size(), std::size_t(6));
  QCOMPARE(rows[0].method, std::string("generalized"));
  QCOMPARE(rows[1].label, std::string("Generalized ChainMail, 2 sweeps"));
  QVERIFY(rows[0].refusal.empty() && *rows[0].ms_per_move > 0 && rows[0].to_exact->max > 0);
  QCOMPARE(rows[2].to_exact->max, 0.0);
  QCOMPARE(rows[2].violation->fraction, 0.0);
  QVERIFY(has(rows[4].refusal, "only on grids") && !rows[4].ms_per_move);

  // The drag is the one that a Deformer does.
  cm::Deformer deformer(body, "generalized");
  cm::Handle handle = deformer.grab(drag.elements);
  for (const cm::Motion& motion : drag.path) {
    deformer.move(handle, handle.after(motion));
  }
  QCOMPARE(rows[0].violation->max, cm::violation(deformer.body()).max);

  QVERIFY(has(comparison.text(), "my sheet") && has(comparison.text(), "Generalized ChainMail"));
  QVERIFY(has(comparison.html(), "<!DOCTYPE html>") && has(comparison.html(), "my sheet") &&
          !has(comparison.html(), "pull <b>"));
  QVERIFY(has(comparison.json(), "\"algorithm\": \"generalized\""));
  QVERIFY(has(comparison.csv(), ",generalized,2,"));
  const QTemporaryDir folder;
  const std::filesystem::path path = folder.filePath("a/report").toStdString();
  comparison.write(path);
  std::ifstream csv(path / "report.csv");
  std::ostringstream written;
  written << csv.rdbuf();
  QCOMPARE(written.str(), comparison.csv());
  QVERIFY(std::filesystem::exists(path / "report.html") && std::filesystem::exists(path / "report.json"));
  QVERIFY(has(refusal_of([&] { comparison.write(path / "report.csv" / "below"); }), "cannot be created"));
  QCOMPARE(cm::compare(body, {}, {.methods = {"exact"}, .repetitions = 1}).rows().size(), std::size_t(3));
}

void ApiTest::many_elements_are_compared() {
  const cm::Body body(cm::make_cloth(8, 8));
  const cm::Drag drag{.name = "turn", .elements = {0, 1, 8, 9}, .path = {{{-3, -2, 0}, {{0, 0, 1}, 30}}}};
  const auto rows =
      cm::compare(body, {drag},
                  {.methods = {"natural-queue"}, .precision = cm::Precision::double_precision, .repetitions = 1})
          .rows();
  cm::Deformer deformer(body, "natural-queue");
  cm::Handle handle = deformer.grab(drag.elements);
  deformer.move(handle, handle.after(drag.path[0]));
  QCOMPARE(rows.at(0).refusal, std::string());
  QCOMPARE(rows.at(0).violation->max, cm::violation(deformer.body()).max);
}

void ApiTest::methods_are_compared_with_physics() {
  cm::Body body(organ());
  body.pin(body.mesh().side("left"));
  const cm::ElementId tip = body.mesh().side("right").back();
  const cm::Drag drag{.name = "bend", .elements = {tip}, .path = {{{0, 0.3, 0}, {}}, {{0, 0.6, 0}, {}}}};
  cm::CompareOptions options;
  options.methods = {"natural-queue", "fem"};
  options.repetitions = 1;
  options.seconds = 0.01;
  options.precision = cm::Precision::double_precision;
  options.against = cm::Reference::physics;
  const cm::Comparison comparison = cm::compare(body, {drag}, options);
  const auto& rows = comparison.rows();
  QCOMPARE(rows.size(), std::size_t(3));
  QCOMPARE(rows[0].method, std::string("nothing"));
  QVERIFY(!rows[0].ms_per_move && rows[0].to_physics->relative > 0.5);
  QVERIFY(*rows[1].ms_per_move > 0 && *rows[2].prepare_ms > 0);
  QVERIFY(rows[2].to_physics->relative < rows[1].to_physics->relative);

  cm::Deformer deformer(body, "natural-queue");
  cm::Handle handle = deformer.grab({tip});
  deformer.move(handle, handle.after(drag.path[0]));
  deformer.move(handle, handle.after(drag.path[1]));
  const auto reference = cm::reference_solution(deformer.body(), {tip});
  QVERIFY(std::abs(cm::physical_error(deformer.body(), reference).relative - rows[1].to_physics->relative) < 1e-9);
  QVERIFY(has(comparison.html(), "Linear FEM") && has(comparison.csv(), "nothing"));
}

void ApiTest::bad_comparisons_are_refused() {
  cm::Body body(cm::make_grid(4, 4));
  body.pin({15});
  const cm::Drag drag{.name = "drag", .elements = {0}, .path = {{{-1, 0, 0}, {}}}};
  const auto refused = [&](const std::vector<cm::Drag>& drags, const cm::CompareOptions& options,
                           const std::string& reason) {
    const std::string refusal = refusal_of([&] { cm::compare(body, drags, options); });
    QVERIFY2(has(refusal, reason), refusal.c_str());
  };
  refused({drag}, {.methods = {"magic"}}, "there is no such method");
  refused({drag}, {.methods = {"exact", "exact"}}, "given twice");
  refused({drag}, {.sweeps = {-1}}, "relax");
  refused({drag}, {.scheme = cm::RelaxationScheme::equilibrium}, "relaxation");
  refused({drag}, {.relax_step = no_number}, "relax-step");
  refused({drag}, {.repetitions = 0}, "repetitions");
  refused({drag}, {.seconds = no_number}, "seconds");
  refused({{"empty", {0}, {}}}, {}, "its path is empty");
  refused({{"none", {}, {{{1, 0, 0}, {}}}}}, {}, "it has no elements");
  refused({{"far", {99}, {{{1, 0, 0}, {}}}}}, {}, "element 99");
  refused({{"pinned", {15}, {{{1, 0, 0}, {}}}}}, {}, "pinned");
  refused({{"nan", {0}, {{{no_number, 0, 0}, {}}}}}, {}, "not a finite number");
  refused({{"off", {0}, {{{0, 0, 1}, {}}}}}, {}, "does not extend along z");
  refused({{"turn", {0, 1}, {{{}, {{1, 0, 0}, 5}}}}}, {}, "leave the space");
  refused({{"many", {0, 1}, {{{1, 0, 0}, {}}}}}, {.against = cm::Reference::physics}, "it grabs many elements");
  body.cut({0});
  refused({drag}, {.against = cm::Reference::physics}, "without cuts");
  body.uncut({0});
  body.unpin({15});
  refused({drag}, {.against = cm::Reference::physics}, "nothing pins it");
}

void ApiTest::softness_is_calibrated() {
  const MeshPointer mesh = chainmail::generate({MeshKind::cloth, {5, 5, 1}});
  cm::Body body(cm::make_cloth(5, 5));
  body.pin(body.mesh().side("top"));
  body.set_elasticity({.poisson = 0.4});
  const cm::CalibrateOptions options{.seed = 3, .drags = 2, .held_out = 1, .evaluations = 20, .most_sweeps = 3};
  const State before(body);
  const cm::Calibration found = cm::calibrate(body, options);
  QVERIFY(State(body) == before);

  chainmail::CalibrationOptions how;
  how.pins = layer(*mesh, *chainmail::find_side("top"));
  how.elastic.material.poisson = 0.4;
  how.seed = 3;
  how.drags = 2;
  how.held_out = 1;
  how.evaluations = 20;
  how.most_sweeps = 3;
  const auto expected = calibrate(mesh, chainmail::Cuts(mesh), how);
  const chainmail::CalibrationOptions usual;
  const cm::CalibrateOptions ours;
  QVERIFY(ours.seed == usual.seed && ours.drags == usual.drags && ours.held_out == usual.held_out &&
          ours.evaluations == usual.evaluations && ours.most_sweeps == usual.most_sweeps &&
          ours.method == cm::methods()[std::size_t(usual.algorithm)].name);
  QCOMPARE(found.softness.compression, expected.softness.compression);
  QCOMPARE(found.softness.stretch, expected.softness.stretch);
  QCOMPARE(found.softness.shear, expected.softness.shear);
  QCOMPARE(found.sweeps, expected.sweeps);
  QCOMPARE(found.evaluations, expected.evaluations);
  QCOMPARE(found.fitted.after.relative, expected.fitted.after.relative);
  QCOMPARE(found.held_out.before.rms, expected.held_out.before.rms);
  QVERIFY(has(found.json, "held_out"));

  const QTemporaryDir folder;
  const std::filesystem::path path = folder.filePath("felt.json").toStdString();
  cm::write_preset(path, "felt", found.softness);
  std::ifstream preset(path);
  std::ostringstream written;
  written << preset.rdbuf();
  QVERIFY(has(written.str(), "\"felt\"") && has(written.str(), "\"compression\""));
}

void ApiTest::bad_calibrations_are_refused() {
  cm::Body body(cm::make_cloth(5, 5));
  QVERIFY(has(refusal_of([&] { cm::calibrate(body); }), "nothing pins"));
  body.pin(body.mesh().side("top"));
  QVERIFY(has(refusal_of([&] { cm::calibrate(body, {.method = "magic"}); }), "there is no such method"));
  QVERIFY(has(refusal_of([&] { cm::calibrate(body, {.method = "fem"}); }), "no softness"));
  QVERIFY(has(refusal_of([&] { cm::calibrate(body, {.drags = 0}); }), "drags"));
  QVERIFY(has(refusal_of([&] { cm::calibrate(body, {.held_out = 0}); }), "held_out"));
  QVERIFY(has(refusal_of([&] { cm::calibrate(body, {.evaluations = 0}); }), "evaluations"));
  QVERIFY(has(refusal_of([&] { cm::calibrate(body, {.most_sweeps = -1}); }), "most_sweeps"));
  const QTemporaryDir folder;
  const std::filesystem::path path = folder.filePath("preset.json").toStdString();
  QVERIFY(!refusal_of([&] { cm::write_preset(path, "", {}); }).empty());
  QVERIFY(!refusal_of([&] { cm::write_preset(path, "felt", {.compression = 2}); }).empty());
  QVERIFY(!std::filesystem::exists(path));
}

void ApiTest::an_own_method_is_listed_and_moves() {
  register_own_methods();
  const cm::MethodInfo own = cm::method_info("own-queue");
  QCOMPARE(own.label, std::string("Own queue"));
  QCOMPARE(own.source, std::string("a test"));
  QVERIFY(own.is_registered && own.family == cm::MethodFamily::chainmail);
  QCOMPARE(cm::method_info("own-boxes").label, std::string("own-boxes"));
  for (const cm::Precision precision : {cm::Precision::single_precision, cm::Precision::double_precision}) {
    for (const cm::Mesh& mesh : {cm::make_line(9), cm::make_cloth(7, 7), organ()}) {
      cm::Body body(mesh, precision);
      body.pin({mesh.element_count() - 1});
      body.cut({2});
      cm::Deformer expected(body, "natural-queue"), queue(body, "own-queue"), boxes(body, "own-boxes");
      for (const double by : {-0.3, -3.0, -1.0}) {
        const auto result = expected.move(1, mesh.rest_position(1) + cm::Vector3{by, 0, 0});
        for (cm::Deformer* own_one : {&queue, &boxes}) {
          QCOMPARE(own_one->move(1, mesh.rest_position(1) + cm::Vector3{by, 0, 0}).moved, result.moved);
          QVERIFY(same_numbers(own_one->body().positions(), expected.body().positions()));
          QVERIFY(std::ranges::equal(own_one->moved(), expected.moved()));
        }
      }
      QCOMPARE(queue.relax(2), expected.relax(2));
      QVERIFY(same_numbers(queue.body().positions(), expected.body().positions()));
    }
  }
  cm::Deformer many(cm::make_grid(6, 6), "own-queue"), expected(cm::make_grid(6, 6), "natural-queue");
  cm::Handle handle = many.grab({0, 1}), same = expected.grab({0, 1});
  many.move(handle, handle.after({{-2, 0, 0}, {{0, 0, 1}, 45}}));
  expected.move(same, same.after({{-2, 0, 0}, {{0, 0, 1}, 45}}));
  QVERIFY(same_numbers(many.body().positions(), expected.body().positions()));
}

void ApiTest::an_own_method_is_compared() {
  register_own_methods();
  cm::Body body(cm::make_cloth(8, 8));
  body.set_softness({0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, {.compression = 1, .stretch = 1, .shear = 0});
  const cm::Drag drag{.name = "pull", .elements = {63}, .path = {{{4, 2, 0}, {}}}};
  const cm::Comparison comparison =
      cm::compare(body, {drag}, {.methods = {"own-queue", "natural-queue"}, .sweeps = {0, 3}, .repetitions = 1});
  const auto& rows = comparison.rows();
  QCOMPARE(rows.size(), std::size_t(4));
  QCOMPARE(rows[0].label, std::string("Own queue"));
  QCOMPARE(rows[0].refusal, std::string());
  QCOMPARE(rows[0].to_exact->rms, rows[2].to_exact->rms);
  QCOMPARE(rows[1].to_exact->rms, rows[3].to_exact->rms);
  QVERIFY(has(comparison.html(), "Own queue") && has(comparison.json(), "own-queue") &&
          has(comparison.csv(), ",own-queue,0,"));
  // Without a list of methods, all of the family take part.
  const auto all = cm::compare(body, {drag}, {.repetitions = 1}).rows();
  QVERIFY(std::ranges::count(all, "own-queue", &cm::ComparisonRow::method) == 1);
  body.pin(body.mesh().side("left"));
  const auto found = cm::calibrate(body, {.method = "own-queue", .drags = 1, .held_out = 1, .evaluations = 5});
  const auto expected = cm::calibrate(body, {.method = "natural-queue", .drags = 1, .held_out = 1, .evaluations = 5});
  QCOMPARE(found.softness, expected.softness);
}

void ApiTest::an_own_method_that_throws_moves_nothing() {
  static std::function<void(cm::MovingBody&)> fail;
  if (!is_known("failing")) {
    cm::register_method({.name = "failing"},
                        [] { return std::make_unique<Failing>([](cm::MovingBody& body) { fail(body); }); });
  }
  for (const cm::Precision precision : {cm::Precision::single_precision, cm::Precision::double_precision}) {
    cm::Deformer deformer(cm::make_grid(3, 3), "failing", precision);
    fail = [](cm::MovingBody&) {};
    QCOMPARE(deformer.move(0, {-1.1, 0, 0}).moved, std::uint64_t(2));
    QVERIFY(std::ranges::equal(deformer.moved(), std::vector<cm::ElementId>{8, 7}));
    QVERIFY((deformer.body().position(7) == cm::Vector3{1, 3, 0}));
    deformer.body().set_positions(deformer.body().mesh().rest_positions());
    const State before(deformer.body());
    fail = [](cm::MovingBody&) { throw cm::Error("mine", "it fails", "do not use it"); };
    QCOMPARE(refusal_of([&] { deformer.move(0, {-3, 0, 0}); }), std::string("mine: it fails; do not use it"));
    QVERIFY(State(deformer.body()) == before && deformer.moved().empty());
    fail = [](cm::MovingBody&) { throw std::logic_error("another kind"); };
    QVERIFY_EXCEPTION_THROWN(deformer.move(0, {-3, 0, 0}), std::logic_error);
    QVERIFY(State(deformer.body()) == before);
    fail = [](cm::MovingBody&) { throw cm::Cancelled(); };
    QVERIFY_EXCEPTION_THROWN(deformer.move(0, {-3, 0, 0}), cm::Cancelled);
    QVERIFY(State(deformer.body()) == before);
  }
  fail = [](cm::MovingBody&) { throw cm::Error("mine", "it fails", "do not use it"); };
  const auto rows = cm::compare(cm::Body(cm::make_grid(3, 3)), {{"d", {0}, {{{-1, 0, 0}, {}}}}},
                                {.methods = {"failing"}, .repetitions = 1})
                        .rows();
  QCOMPARE(rows.at(0).refusal, std::string("mine: it fails; do not use it"));
}

void ApiTest::an_own_method_cannot_move_what_is_fixed() {
  static std::function<void(cm::MovingBody&)> act;
  if (!is_known("acting")) {
    cm::register_method({.name = "acting"},
                        [] { return std::make_unique<Failing>([](cm::MovingBody& body) { act(body); }); });
  }
  cm::Deformer deformer(cm::make_grid(3, 3), "acting", cm::Precision::single_precision);
  deformer.body().pin({4});
  deformer.body().cut(7, 8);
  const State before(deformer.body());
  const auto refused = [&](std::function<void(cm::MovingBody&)> what, const std::string& reason) {
    act = std::move(what);
    const std::string refusal = refusal_of([&] { deformer.move(0, {-1, 0, 0}); });
    QVERIFY2(has(refusal, reason), refusal.c_str());
    QVERIFY(State(deformer.body()) == before);
  };
  refused([](cm::MovingBody& body) { body.set_position(0, {}); }, "it is part of the handle");
  refused([](cm::MovingBody& body) { body.set_position(4, {}); }, "it is pinned");
  refused([](cm::MovingBody& body) { body.set_position(9, {}); }, "element 9");
  refused([](cm::MovingBody& body) { body.set_position(1, {no_number, 0, 0}); }, "not a finite number");
  refused([](cm::MovingBody& body) { body.set_position(1, {1e38, 0, 0}); }, "out of the range");
  refused([](cm::MovingBody& body) { body.set_position(1, {0, 0, 1}); }, "does not extend along z");
  refused([](cm::MovingBody& body) { body.clamp(4, 1); }, "it is pinned");
  refused([](cm::MovingBody& body) { body.clamp(0, 1); }, "it is part of the handle");
  refused([](cm::MovingBody& body) { body.clamp(8, 0); }, "they are not linked");
  refused([](cm::MovingBody& body) { body.clamp(8, 7); }, "the link is cut");
  refused([](cm::MovingBody& body) { (void)body.valid_region(9, 1); }, "element 9");
  refused([](cm::MovingBody& body) { body.neighbours(9); }, "element 9");
  refused([](cm::MovingBody& body) { (void)body.is_fixed(9); }, "element 9");
  refused([](cm::MovingBody& body) { (void)body.position(9); }, "element 9");
  act = [](cm::MovingBody& body) {
    QVERIFY(body.is_fixed(0) && body.is_fixed(4) && !body.is_fixed(1));
    QVERIFY(std::ranges::equal(body.neighbours(8), std::vector<cm::ElementId>{5}));
    QCOMPARE(body.mesh().element_count(), 9u);
  };
  deformer.move(0, {-1, 0, 0});
}

void ApiTest::bad_registrations_are_refused() {
  const std::size_t before = cm::methods().size();
  const auto make = [] { return std::make_unique<OwnQueue>(); };
  for (const char* name : {"", "Upper", "with space", "exact", "original", "3d", "nothing", "a,b"}) {
    QVERIFY2(!refusal_of([&] { cm::register_method({.name = name}, make); }).empty(), name);
  }
  QVERIFY(has(refusal_of([] { cm::register_method({.name = "empty"}, {}); }), "there is no factory"));
  QCOMPARE(cm::methods().size(), before);
  cm::register_method({.name = "null", .label = "two\nlines"}, [] { return std::unique_ptr<cm::Method>(); });
  QVERIFY(!has(cm::method_info("null").label, "\n"));
  QVERIFY(has(refusal_of([&] { cm::register_method({.name = "null"}, make); }), "there is a method with this name"));
  cm::Deformer deformer(cm::make_grid(2, 2), "null");
  QVERIFY(has(refusal_of([&] { deformer.move(0, {-1, 0, 0}); }), "its factory made none"));
}

QTEST_APPLESS_MAIN(ApiTest)
#include "test_api.moc"
