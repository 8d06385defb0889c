#include <QTemporaryDir>
#include <QtTest>
#include <sstream>

#include "chainmail/follow_pass.h"
#include "chainmail/list_method.h"
#include "command_line/common.h"
#include "core/chainmail/recorded.h"
#include "files/formats/obj.h"
#include "files/mesh/mesh_file.h"
#include "files/mesh/mesh_formats.h"
#include "files/mesh/open_mesh.h"
#include "files/results/results_json.h"
#include "files/text/described_json.h"
#include "mesh/extra_row.h"
#include "report/page/report.h"
#include "report/run/physics.h"
#include "solver/algorithms.h"

namespace chainmail {
template <>
std::vector<MeshFormat>& table_of();
template <>
std::vector<const report::Figure*>& table_of();
}  // namespace chainmail

using namespace chainmail;
using namespace chainmail::test;
using command_line::algorithms_help;
using command_line::algorithms_of;
using command_line::names_of;

/// An algorithm is one entry of a table, and so is a parameter, a figure or a format. Every list of them includes a new
/// entry.
class OneEntryTest : public QObject {
  Q_OBJECT

 private slots:
  void an_algorithm_is_listed();
  void an_algorithm_is_parsed();
  void an_algorithm_is_written();
  void an_algorithm_runs();
  void an_algorithm_is_replayed();
  void an_algorithm_is_a_contestant();
  void an_entry_goes_with_its_object();
  void names_are_unique();
  void a_figure_is_written_and_read();
  void a_format_is_opened_and_written();
  void a_parameter_is_an_option();
  void a_parameter_is_checked();
  void a_member_is_an_option();
  void a_member_is_written_and_read();
  void defaults_and_limits_are_those_of_the_table();
};

namespace {

constexpr auto dummy = Algorithm(1000);

/// A waiting list like the one of Spiral.
struct DummyList : SpiralList {};

AlgorithmInfo dummy_entry() {
  return {.algorithm = dummy,
          .name = "dummy",
          .alias = "another-name",
          .label = "Dummy ChainMail",
          .source = "nobody 2000",
          .summary = "does what Spiral does",
          .style = {"M0 0H1V1Z", "#123456"},
          .make = make_list_method<DummyList>,
          .history = follow_list<DummyList>};
}

constexpr Parameter dummy_parameter{.name = "dummy",
                                    .label = "Dummy",
                                    .unit = "of nothing",
                                    .default_value = 2.5,
                                    .lowest = 1,
                                    .highest = 4,
                                    .slider_highest = 4,
                                    .step = 0.5,
                                    .decimals = 1,
                                    .help = "a number without a meaning"};

struct DummySettings {
  double value = dummy_parameter.default_value;
  std::array<std::uint32_t, 3> counts{2, 2, 2};
  bool on = false;

  bool operator==(const DummySettings&) const = default;
};

}  // namespace

template <>
inline constexpr std::array chainmail::members_of<DummySettings>{
    number<&DummySettings::value>("value", dummy_parameter),
    may_be_absent(number<&DummySettings::counts>("counts", parameters::lattice)),
    yes_or_no<&DummySettings::on>("on", "true or false")};

namespace {

std::string message(const std::function<void()>& run) {
  try {
    run();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

}  // namespace

void OneEntryTest::an_algorithm_is_listed() {
  const std::size_t family = algorithms().size(), others = elastic_algorithms().size();
  const ExtraAlgorithm extra(dummy_entry());
  QCOMPARE(algorithms().size(), family + 1);
  QCOMPARE(elastic_algorithms().size(), others);
  QVERIFY(algorithms().back().algorithm == dummy);
  QVERIFY(elastic_algorithms().front().algorithm == Algorithm::linear_fem);
  QVERIFY(std::ranges::count(names_of(every_algorithm()), "another-name") == 1);
  QVERIFY(contains(algorithms_help(algorithms()), "another-name   Dummy ChainMail: does what Spiral does\n"));
  QCOMPARE(report::style_at(report::style_of(dummy)).colour, std::string_view("#123456"));
  QCOMPARE(report::label(report::Contestant{dummy, 3}), std::string("Dummy ChainMail, 3 sweeps"));
}

void OneEntryTest::an_algorithm_is_parsed() {
  const auto chosen = [](const std::string& list) { return algorithms_of("--algorithms", list, algorithms()); };
  QVERIFY(contains(message([&] { chosen("dummy"); }), "'dummy' is not known"));
  const ExtraAlgorithm extra(dummy_entry());
  QVERIFY((chosen("spiral,dummy") == std::vector<Algorithm>{Algorithm::spiral, dummy}));
  QVERIFY(chosen("another-name") == std::vector<Algorithm>{dummy});
  QVERIFY(contains(message([&] { chosen("dummy,another-name"); }), "is given twice"));
  QVERIFY(contains(message([&] { chosen("none"); }), "exact or another-name"));
  QVERIFY(chosen("original") == chosen("3d"));
}

void OneEntryTest::an_algorithm_is_written() {
  const ExtraAlgorithm extra(dummy_entry());
  report::Results results;
  results.objects.push_back({.name = "object", .drags = {{.name = "drag", .moves = 1}}});
  results.rows.push_back({.drag = 0, .contestant = {dummy}, .refusal = "no"});
  std::ostringstream json, csv;
  write_json(json, results);
  write_csv(csv, results);
  QVERIFY(contains(json.str(), "\"algorithm\": \"dummy\""));
  QVERIFY(contains(csv.str(), ",dummy,0,"));
}

void OneEntryTest::an_algorithm_runs() {
  const ExtraAlgorithm extra(dummy_entry());
  for (const MeshPointer& mesh : {make_mesh(MeshKind::line, {9, 1, 1}), make_mesh(MeshKind::cloth, {6, 5, 1}),
                                  make_mesh(MeshKind::tetra, {4, 3, 3})}) {
    for (const Precision precision : precisions) {
      const auto solver = std::make_unique<Deformer>(mesh, dummy, precision),
                 spiral = std::make_unique<Deformer>(mesh, Algorithm::spiral, precision);
      for (const double by : {2.0, -1.5}) {
        const Point target = mesh->rest_position(1) + Point(by, 0, 0);
        QCOMPARE(solver->move(1, target).moved, spiral->move(1, target).moved);
        QVERIFY(same_bits(positions_of(*solver, *mesh), positions_of(*spiral, *mesh)));
      }
    }
  }
}

void OneEntryTest::an_algorithm_is_replayed() {
  const ExtraAlgorithm extra(dummy_entry());
  const auto mesh = make_mesh(MeshKind::grid, {5, 4, 1});
  Recorded recorded(mesh, dummy), spiral(mesh, Algorithm::spiral);
  const auto pass = recorded.drag(7, Point(4, -3, 0)), expected = spiral.drag(7, Point(4, -3, 0));
  const WaitingHistory history = waiting_history(*pass);
  QVERIFY(history.known() && !history.candidates().empty());
  QCOMPARE(history.at(3), waiting_history(*expected).at(3));
}

void OneEntryTest::an_algorithm_is_a_contestant() {
  const ExtraAlgorithm extra(dummy_entry());
  const auto contestants = report::contestants_of({dummy}, {0, 3}, true, {});
  QVERIFY((contestants == std::vector<report::Contestant>{{}, {dummy}, {dummy, 3}}));
}

void OneEntryTest::an_entry_goes_with_its_object() {
  const std::size_t before = every_algorithm().size();
  { const ExtraAlgorithm extra(dummy_entry()); }
  QCOMPARE(every_algorithm().size(), before);
  QVERIFY(!find_algorithm("dummy") && !find_algorithm("another-name"));
}

void OneEntryTest::names_are_unique() {
  std::set<std::string_view> names, shapes;
  std::size_t count = 0;
  for (const AlgorithmInfo& one : every_algorithm()) {
    for (const std::string_view name : {one.name, one.alias}) {
      names.insert(name);
      count += name.empty() ? 0 : 1;
    }
    QVERIFY(!one.label.empty() && !one.source.empty() && !one.summary.empty());
    shapes.insert(one.style.path);
  }
  names.erase("");
  QCOMPARE(names.size(), count);
  QCOMPARE(shapes.size(), every_algorithm().size());
}

void OneEntryTest::a_figure_is_written_and_read() {
  static constexpr report::Figure figure{"dummy_ms", "dummy", "of nothing", "ms", "a figure without a meaning"};
  QTemporaryDir folder;
  const std::filesystem::path path = folder.filePath("report.json").toStdString();
  report::Results results;
  results.objects.push_back({.name = "object", .drags = {{.name = "drag", .moves = 1}}});
  results.rows.push_back({.drag = 0, .contestant = {Algorithm::spiral}});
  results.rows[0].set(figure, 2.5);
  {
    const ExtraRow<const report::Figure*> extra(&figure);
    std::ofstream json(path);
    std::ostringstream csv;
    write_json(json, results);
    json.close();
    write_csv(csv, results);
    QVERIFY(contains(csv.str(), ",dummy_ms"));
    const report::Results again = read_results(path);
    QVERIFY(again.rows[0].find(figure) != nullptr);
    QCOMPARE(again.rows[0].find(figure)->number, 2.5);
  }
  QVERIFY(report::find_figure("dummy_ms") == nullptr);
}

void OneEntryTest::a_format_is_opened_and_written() {
  QTemporaryDir folder;
  const auto path = [&](const char* name) { return std::filesystem::path(folder.filePath(name).toStdString()); };
  const MeshPointer line = make_mesh(MeshKind::line, {3, 1, 1});
  {
    const ExtraRow<MeshFormat> extra(
        {.name = "Dummy",
         .endings = ".dummy",
         .help = "one link",
         .signs = {"dummy 1"},
         .read_mesh = [](RegularFile, const ReadOptions&,
                         const Progress&) { return read_obj("v 0 0 0\nv 1 0 0\nl 1 2\n", "dummy"); },
         .write = [](std::ostream& out, const MeshState&, const Progress&) { out << "dummy 1\n"; }});
    QVERIFY(mesh_endings(FormatUse::read).ends_with(" or .dummy"));
    QVERIFY(contains(mesh_formats_help(FormatUse::write), "  .dummy, Dummy: one link\n"));
    save_mesh(path("a.DUMMY"), {*line, Cuts(), rest_positions(*line), {}});
    std::filesystem::copy(path("a.DUMMY"), path("unnamed"));
    for (const char* name : {"a.DUMMY", "unnamed"}) {
      QCOMPARE(open_mesh(path(name)).mesh->link_count(), LinkId{1});
    }
  }
  QVERIFY(contains(message([&] { open_mesh(path("a.DUMMY")); }), "the ending .dummy is not known"));
}

void OneEntryTest::a_parameter_is_an_option() {
  CLI::App app;
  command_line::Options options(app);
  double value = dummy_parameter.default_value;
  options.add(dummy_parameter, value);
  QVERIFY(contains(app.help(), "--dummy"));
  QVERIFY(contains(app.help(), "a number without a meaning [2.5]"));
  options.read();
  QCOMPARE(value, 2.5);
  app.parse(std::vector<std::string>{"3.5", "--dummy"});
  options.read();
  QCOMPARE(value, 3.5);
  app.parse(std::vector<std::string>{"5", "--dummy"});
  QCOMPARE(message([&] { options.read(); }), std::string("--dummy: Dummy 5 is out of range; use 1 to 4"));
}

void OneEntryTest::a_parameter_is_checked() {
  QCOMPARE(message([] { check(dummy_parameter, 0.5); }), std::string("dummy: Dummy 0.5 is out of range; use 1 to 4"));
  for (const double accepted : {1.0, 2.5, 4.0}) {
    QCOMPARE(message([=] { check(dummy_parameter, accepted); }), std::string());
  }
  for (const double refused : {std::nextafter(1.0, 0.0), std::nextafter(4.0, 5.0), std::nan("")}) {
    QVERIFY(!message([=] { check(dummy_parameter, refused); }).empty());
  }
  Parameter open = dummy_parameter;
  open.highest = parameters::no_highest;
  QCOMPARE(range_of(open), std::string("1 or more"));
  open.lowest = parameters::above_zero;
  QCOMPARE(range_of(open), std::string("a number above 0"));
  QVERIFY(!message([=] { check(open, 0); }).empty());
  QVERIFY(!message([=] { check(open, std::numeric_limits<double>::infinity()); }).empty());
}

void OneEntryTest::a_member_is_an_option() {
  CLI::App app;
  command_line::Options options(app);
  DummySettings settings;
  options.add_numbers(settings);
  QVERIFY(contains(app.help(), "a number without a meaning [2.5]"));
  app.parse(std::vector<std::string>{"3x4", "--lattice", "3.5", "--dummy"});
  options.read();
  QVERIFY((settings == DummySettings{3.5, {3, 4, 4}}));
  const auto refused = [&](const std::string& option, const std::string& value) {
    app.parse(std::vector<std::string>{value, option});
    return message([&] { options.read(); });
  };
  QCOMPARE(refused("--dummy", "5"), std::string("--dummy: Dummy 5 is out of range; use 1 to 4"));
  QCOMPARE(refused("--lattice", "3x9"), std::string("--lattice: Control points 9 is out of range; use 2 to 8"));
  QVERIFY(contains(refused("--lattice", "3x3x3x3"), "'3x3x3x3' is not a number of control points; write one number"));
  CLI::App other;
  command_line::Options some(other);
  some.add_numbers(settings, {"value"});
  QVERIFY(contains(other.help(), "--dummy") && !contains(other.help(), "--lattice"));
}

void OneEntryTest::a_member_is_written_and_read() {
  const DummySettings settings{3.5, {3, 4, 5}, true};
  const JsonFields fields("file");
  const auto read = [&](const std::string& text) {
    return read_members<DummySettings>(fields, nlohmann::json::parse(text));
  };
  nlohmann::ordered_json json;
  add_members(json, settings);
  QCOMPARE(json.dump(), std::string(R"({"value":3.5,"counts":[3,4,5],"on":true})"));
  QVERIFY(read(json.dump()) == settings);
  QVERIFY((read(R"({"value":3.5,"on":true})") == DummySettings{3.5, {2, 2, 2}, true}));
  for (const char* wrong :
       {R"({"value":3.5})", R"({"value":5,"on":true})", R"({"value":3.5,"on":1})",
        R"({"value":3.5,"counts":[3,4],"on":true})", R"({"value":3.5,"counts":[3,4,9],"on":true})"}) {
    QVERIFY2(message([&] { read(wrong); }).starts_with("file: "), wrong);
  }
  QCOMPARE(message([] { check_members(DummySettings{5}); }), std::string("dummy: Dummy 5 is out of range; use 1 to 4"));
}

void OneEntryTest::defaults_and_limits_are_those_of_the_table() {
  const LinkSoftness softness;
  QCOMPARE(softness.compression, parameters::compression.default_value);
  QCOMPARE(softness.stretch, parameters::stretch.default_value);
  QCOMPARE(softness.shear, parameters::shear.default_value);
  check(LinkSoftness{parameters::compression.highest, parameters::stretch.lowest, parameters::shear.lowest});
  QVERIFY(contains(message([] {
                     check(LinkSoftness{1.01, 1, 0});
                   }),
                   "compression: Compression 1.01 is out of range; use 0 to 1"));
  ElasticOptions elastic;
  QCOMPARE(elastic.material.young, parameters::young.default_value);
  QCOMPARE(elastic.material.poisson, parameters::poisson.default_value);
  QCOMPARE(double(elastic.lattice[2]), parameters::lattice.default_value);
  elastic.material.poisson = parameters::poisson.highest;
  check(elastic);
  elastic.lattice[1] = static_cast<std::uint32_t>(parameters::lattice.highest) + 1;
  QVERIFY(contains(message([&] { check(elastic); }), "lattice: Control points 9 is out of range; use 2 to 8"));
  QCOMPARE(MeshRecipe().spacing, parameters::spacing.default_value);
}

QTEST_APPLESS_MAIN(OneEntryTest)
#include "test_one_entry.moc"
