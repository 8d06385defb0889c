#include <QTemporaryDir>
#include <QtTest>
#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "core/api/api_support.h"
#include "program.h"

namespace chainmail::test_api_programs {

/// The part of the public interface from which programs like the command line are made: files, tables of what a user
/// may choose, simulations and reports.
class ApiProgramsTest : public QObject {
  Q_OBJECT

 private slots:
  void a_full_disk_is_a_failure_to_write();
  void numbers_have_names_limits_and_help();
  void choices_have_names();
  void lattices_are_made_by_name();
  void formats_say_what_they_hold();
  void a_stream_gets_what_a_file_gets();
  void a_simulation_moves_as_a_deformer_does();
  void a_simulation_reports_its_passes();
  void recorded_moves_are_those_of_calls();
  void objects_are_compared_in_one_report();
  void the_suite_is_listed();
};

namespace {

std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void write(const std::filesystem::path& path, const std::string& text) { std::ofstream(path) << text; }

class Folder {
 public:
  std::filesystem::path operator/(const char* name) const { return folder_.filePath(name).toStdString(); }

 private:
  QTemporaryDir folder_;
};

}  // namespace

void ApiProgramsTest::a_full_disk_is_a_failure_to_write() {
  const auto fill = [] { cm::write_file("/dev/full", [](std::ostream& out) { out << "text"; }); };
  QVERIFY_EXCEPTION_THROWN(fill(), cm::WriteFailure);
  const auto nowhere = [] { cm::write_file("/nonexistent/x", [](std::ostream&) {}); };
  try {
    nowhere();
    QFAIL("it was written");
  } catch (const cm::WriteFailure&) {
    QFAIL("nothing was written yet");
  } catch (const cm::Error& error) {
    QCOMPARE(error.at("elsewhere").where(), std::string("elsewhere"));
    QCOMPARE(error.at("elsewhere").problem(), error.problem());
  }
}

void ApiProgramsTest::numbers_have_names_limits_and_help() {
  std::set<std::string_view> names;
  for (const cm::Parameter& one : cm::parameters()) {
    QVERIFY(names.insert(one.name).second);
    QVERIFY(!one.label.empty() && !one.help.empty() && !cm::range_of(one).empty());
    cm::check(one, one.default_value);
    cm::check(one, one.lowest);
    cm::check(one, one.highest);
    const std::string refusal = refusal_of([&] { cm::check(one, no_number); });
    QVERIFY2(has(refusal, std::string(one.name) + ":") && has(refusal, cm::range_of(one)), refusal.c_str());
    QVERIFY(!refusal_of([&] { cm::check(one, std::nextafter(one.lowest, -1e9)); }).empty());
    QCOMPARE(cm::parameter(one.name).label, one.label);
  }
  for (const cm::SoftnessNumber& number : cm::softness_numbers()) {
    const cm::Parameter& one = cm::parameter(number.name);
    QCOMPARE(one.default_value, cm::LinkSoftness().*number.value);
    QVERIFY(one.lowest == number.lowest && one.highest == number.highest);
  }
  QCOMPARE(cm::parameter("poisson").default_value, cm::Elasticity().poisson);
  QCOMPARE(cm::parameter("relax-step").default_value, cm::RelaxOptions().step);
  QCOMPARE(cm::parameter("spacing").default_value, cm::LatticeOptions().spacing);
  QVERIFY(has(refusal_of([] { cm::parameter("nope"); }), "nope"));
  QVERIFY(has(refusal_of([] { cm::check(cm::Elasticity{.poisson = 0.5}); }), "poisson"));
  QVERIFY(has(refusal_of([] { cm::check({{}, 10}, cm::make_block(2, 2, 2)); }), "no axis"));
}

void ApiProgramsTest::choices_have_names() {
  for (std::size_t i = 0; i < cm::energy_kinds().size(); ++i) {
    QCOMPARE(std::size_t(cm::energy_kinds()[i].kind), i);
  }
  QCOMPARE(cm::energy_kinds()[std::size_t(cm::EnergyKind::axial)].name, std::string_view("axial"));
  for (std::size_t i = 0; i < cm::relaxation_schemes().size(); ++i) {
    QCOMPARE(std::size_t(cm::relaxation_schemes()[i].scheme), i);
    QCOMPARE(cm::relaxation_schemes()[i].sweeps, cm::RelaxationScheme(i) != cm::RelaxationScheme::equilibrium);
  }
  QCOMPARE(cm::name_of(cm::StrainLaw::neo_hookean), std::string("neo-hookean"));
  QCOMPARE(cm::name_of(cm::StrainLaw::fung), std::string("fung"));
  QCOMPARE(cm::find_method("original")->name, std::string("3d"));
  QVERIFY(!cm::find_method("nope"));
}

void ApiProgramsTest::lattices_are_made_by_name() {
  for (const cm::MeshKind& kind : cm::mesh_kinds()) {
    const cm::Mesh mesh = cm::make_lattice(kind.name, {4, 3, 2}, {.spacing = 0.5});
    QCOMPARE(mesh.element_count(), kind.sizes == 1 ? 4u : kind.sizes == 2 ? 12u : 24u);
    QVERIFY(!kind.help.empty());
  }
  const cm::Mesh made = cm::make_lattice("cloth", {4, 3, 1}), cloth = cm::make_cloth(4, 3);
  QVERIFY(std::ranges::equal(made.links(), cloth.links()) &&
          same_numbers(made.rest_positions(), cloth.rest_positions()));
  QVERIFY(has(refusal_of([] { cm::make_lattice("knot", {4, 3, 1}); }), "'knot'"));
  QVERIFY(!refusal_of([] { cm::make_lattice("grid", {4, 0, 1}); }).empty());
}

void ApiProgramsTest::formats_say_what_they_hold() {
  for (const cm::FileFormat& format : cm::file_formats()) {
    const std::string ending = format.endings.substr(0, format.endings.find(' ')), path = "x" + ending;
    QCOMPARE(has(cm::file_endings(cm::FileUse::read), ending), format.reads);
    QCOMPARE(has(cm::file_endings(cm::FileUse::write), ending), format.writes);
    QCOMPARE(refusal_of([&] { cm::check_format(path, cm::FileUse::read); }).empty(), format.reads);
    QCOMPARE(refusal_of([&] { cm::check_format(path, cm::FileUse::write); }).empty(), format.writes);
    QCOMPARE(refusal_of([&] { cm::check_format(path, cm::FileUse::write_positions); }).empty(),
             format.writes && format.holds_positions);
    QVERIFY(!format.writes || has(cm::file_formats_help(cm::FileUse::write), ending));
  }
  QVERIFY(has(refusal_of([] { cm::check_format("x.foo", cm::FileUse::read); }), "x.foo"));
  QVERIFY(has(refusal_of([] { cm::check_format("x.stl", cm::make_grid(3, 3)); }), "only faces"));
  cm::check_format("x.stl", organ());
  QVERIFY(has(cm::lost_in_format("x.obj", organ()), "no cells"));
  QCOMPARE(cm::lost_in_format("x.msh", organ()), std::string());
}

void ApiProgramsTest::a_stream_gets_what_a_file_gets() {
  const Folder folder;
  cm::Deformer deformer(cm::make_cloth(4, 4), "exact");
  deformer.body().cut(0, 1);
  deformer.move(15, {6, 5, 0});
  for (const char* name : {"a.obj", "a.vtu", "a.csv"}) {
    const auto path = folder / name;
    std::ostringstream moved, rest;
    cm::write_mesh(moved, name, deformer.body());
    cm::write_mesh(path, deformer.body());
    QCOMPARE(moved.str(), content_of(path));
    cm::write_mesh(rest, name, deformer.body().mesh());
    cm::write_mesh(path, deformer.body().mesh());
    QCOMPARE(rest.str(), content_of(path));
    QVERIFY(moved.str() != rest.str());
  }
}

void ApiProgramsTest::a_simulation_moves_as_a_deformer_does() {
  for (const char* method : {"natural-queue", "exact", "fem"}) {
    cm::Body body(organ());
    body.pin(body.mesh().side("left"));
    body.cut(5, 6);
    body.set_softness({.compression = 0.9, .stretch = 1.1, .shear = 0.3});
    body.set_elasticity({.poisson = 0.4});
    const cm::ElementId tip = body.mesh().side("right").back();
    const cm::Vector3 start = body.position(tip), target = start + cm::Vector3{0.5, 1, -0.25};
    cm::Simulation simulation(body, method);
    int passes = 0;
    simulation.set_watcher([&] { ++passes; });
    simulation.move(tip, target, 4);
    QCOMPARE(passes, 4);
    cm::Deformer deformer(body, method);
    for (const double share : {0.25, 0.5, 0.75, 1.0}) {
      deformer.move(tip, start + share * (target - start));
    }
    for (cm::ElementId e = 0; e < body.mesh().element_count(); ++e) {
      QVERIFY(simulation.position(e) == deformer.body().position(e));
    }
    std::ostringstream of_simulation, of_deformer;
    cm::write_mesh(of_simulation, "a.csv", simulation);
    cm::write_mesh(of_deformer, "a.csv", deformer.body());
    QCOMPARE(of_simulation.str(), of_deformer.str());
  }
}

void ApiProgramsTest::a_simulation_reports_its_passes() {
  cm::Body body(cm::make_grid(6, 5));
  body.pin({0});
  cm::Simulation simulation(body, "exact");
  simulation.set_tracing(true);
  simulation.set_relaxation(3, {.scheme = cm::RelaxationScheme::equilibrium});
  simulation.move(29, {5.5, 4.5, 0});
  QVERIFY(simulation.notes().empty());
  simulation.move(29, {50, 4.5, 0});  // the pin stops it
  QCOMPARE(simulation.notes().size(), std::size_t(1));
  QVERIFY(has(simulation.notes()[0], "1 of 2 passes stopped before the target") &&
          has(simulation.notes()[0], "(50, 4.5, 0)"));
  QVERIFY(has(simulation.text(), "exact on 30 elements, 49 links\n") && has(simulation.text(), "stopped by pins at") &&
          has(simulation.text(), "equilibrium: residual"));
  QVERIFY(has(simulation.json(), "\"stopped_at\"") && has(simulation.json(), "\"regions_bind\""));
  cm::Deformer deformer(body, "exact");
  deformer.set_tracing(true);
  deformer.move(29, {5.5, 4.5, 0});
  std::size_t rows = 0;
  std::istringstream trace(simulation.trace_csv());
  for (std::string line; std::getline(trace, line);) {
    rows += line.starts_with("0,") ? 1 : 0;  // of the first pass
  }
  QCOMPARE(rows, deformer.trace().size());
  QVERIFY(rows > 0);

  cm::Simulation handle(body, "natural-queue");
  QVERIFY(!refusal_of([&] { handle.move_handle({{1, 0, 0}, {}}); }).empty());
  handle.grab({28, 29});
  handle.move_handle({{1, 0, 0}, {{0, 0, 1}, 30}}, 2);
  handle.move_handle({{1, 0, 0}, {{0, 0, 1}, 60}});
  QVERIFY((handle.position(28) - cm::Vector3{6.5, 3.5, 0}) == cm::Vector3() ||
          std::abs(handle.position(28).x - 6.5) + std::abs(handle.position(28).y - 3.5) < 1e-12);
  QVERIFY(!refusal_of([&] { handle.pin({28}); }).empty());
  handle.release();
  handle.pin({28});
  QVERIFY(!refusal_of([&] { handle.move(28, {0, 0, 0}); }).empty());
  QVERIFY(has(refusal_of([&] { handle.cut(0, 20); }), "not linked"));
  QVERIFY(has(refusal_of([&] { cm::Simulation(body, "nope"); }), "no such method"));
  QVERIFY(!refusal_of([&] { cm::Simulation(cm::Body(organ()), "3d"); }).empty());
}

void ApiProgramsTest::recorded_moves_are_those_of_calls() {
  const Folder folder;
  write(folder / "moves.json", R"({"version": 1, "commands": [{"do": "pin", "elements": [0]}, {"do": "cut", "links":
    [[7, 8]]}, {"do": "grab", "element": 29}, {"do": "drag", "target": [6, 5, 0]}, {"do": "drag", "target": [7, 6, 0]},
    {"do": "release"}, {"do": "grab", "elements": [3, 4]}, {"do": "drag", "by": [0, -2, 0]}]})");
  const cm::Mesh mesh = cm::make_grid(6, 5);
  const cm::RecordedMoves moves = cm::read_moves(folder / "moves.json", mesh);
  QCOMPARE(moves.pass_count(), std::size_t(3));
  QVERIFY(moves.last_mesh() == mesh);
  cm::Simulation replayed(cm::Body(mesh), "generalized"), called(cm::Body(mesh), "generalized");
  replayed.replay(moves);
  called.pin({0});
  called.cut(7, 8);
  called.move(29, {6, 5, 0});
  called.move(29, {7, 6, 0});
  called.grab({3, 4});
  called.move_handle({{0, -2, 0}, {}});
  for (cm::ElementId e = 0; e < mesh.element_count(); ++e) {
    QVERIFY(replayed.position(e) == called.position(e));
  }
  QVERIFY((replayed.position(3) == cm::Vector3{3, -2, 0}));
}

void ApiProgramsTest::objects_are_compared_in_one_report() {
  std::vector<cm::ComparedObject> objects{{"first", cm::Body(cm::make_grid(4, 4))},
                                          {"second", cm::Body(cm::make_cloth(4, 4))}};
  objects[0].drags = {{"pull", {0}, {{{-2, 0, 0}, {}}}}};
  const cm::CompareOptions options{.methods = {"exact"},
                                   .precision = cm::Precision::double_precision,
                                   .repetitions = 1,
                                   .command = "my command",
                                   .program = "my program 7"};
  const cm::Comparison comparison = cm::compare(objects, options);
  const auto& rows = comparison.rows();
  QCOMPARE(rows.size(), std::size_t(1 + 3));
  QVERIFY(rows[0].object == "first" && rows[0].drag == "pull" && rows[3].object == "second");
  QVERIFY(has(comparison.html(), "my command") && has(comparison.json(), "my program 7"));
  std::vector<std::string> names;
  for (const cm::ReportFile& file : comparison.files()) {
    names.push_back(file.name);
    QVERIFY(!file.content.empty());
  }
  QVERIFY((names == std::vector<std::string>{"report.html", "report.json", "report.csv"}));
  QCOMPARE(cm::compare(objects[0].body, objects[0].drags, options).rows().at(0).to_exact->max, 0.0);

  QCOMPARE(cm::built_in_objects(cm::Reference::exact, {.shear = 0.5}).size(), std::size_t(6));
  for (const cm::ComparedObject& one : cm::built_in_objects(cm::Reference::exact, {.shear = 0.5})) {
    QVERIFY(one.body.softness().shear == 0.5 && one.recorded.size() == 3);
  }
  for (const cm::ComparedObject& one :
       cm::built_in_objects(cm::Reference::physics, {}, cm::EnergyKind::axial, {.poisson = 0.4})) {
    QVERIFY(!one.body.pins().empty() && one.body.elasticity().poisson == 0.4);
    QVERIFY(one.body.energy() == cm::EnergyKind::axial);
  }
  QVERIFY(has(refusal_of([] { cm::built_in_objects(cm::Reference::physics, {}, {}, {.poisson = 1}); }), "poisson"));
}

void ApiProgramsTest::the_suite_is_listed() {
  std::set<std::string> names;
  bool with_organ = false;
  for (const cm::SuiteExperiment& one : cm::suite_experiments()) {
    QVERIFY(names.insert(one.name).second && !one.description.empty());
    with_organ = with_organ || one.needs_organ;
  }
  QVERIFY(names.size() > 10 && with_organ);
  QVERIFY(has(refusal_of([] { cm::run_suite({.experiments = {"nope"}}); }), "nope"));
  QVERIFY(has(refusal_of([] { cm::run_suite({.methods = {"nope"}}); }), "nope"));
  cm::Job job;
  job.cancel();
  QVERIFY_EXCEPTION_THROWN(cm::run_suite({.experiments = {*names.begin()}, .methods = {"natural-queue"}}, job),
                           cm::Cancelled);
  const Folder folder;
  write(folder / "a.json", "{}");
  QVERIFY(has(refusal_of([&] { cm::merge_suites({folder / "a.json"}); }), "a.json"));
  QVERIFY(has(refusal_of([&] { cm::judge_answers(folder / "a.json", {}); }), "a.json"));
}

CHAINMAIL_TEST(ApiProgramsTest)

}  // namespace chainmail::test_api_programs

#include "test_api_programs.moc"
