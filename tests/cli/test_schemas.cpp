#include <array>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <sstream>

#include "cli/chainmail_program.h"
#include "cli/json_schemas.h"
#include "files/results/results_json.h"
#include "files/results/summary.h"
#include "files/session/moves.h"
#include "files/session/softness_presets.h"
#include "files/session_support.h"
#include "folders.h"
#include "mesh/cells.h"
#include "program.h"
#include "report/run/ramp.h"

namespace chainmail::test_schemas {

using namespace chainmail::test;

/// Tests that all JSON of the programs follows its schema, and that the schemas refuse anything else.
class SchemasTest : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase();
  void outputs_begin_with_their_kind_data();
  void outputs_begin_with_their_kind();
  void documents_follow_their_schemas_data();
  void documents_follow_their_schemas();
  void wrong_documents_are_refused_data();
  void wrong_documents_are_refused();
  void every_schema_has_a_document();
  void every_object_is_closed();

 private:
  struct Checked {
    SchemaDocument document;
    bool is_right;
    SchemaCheck check = {};
  };

  void run(const QString& name, const QString& schema, const QString& file, const char* line);
  template <class... Values>
  void write(const QString& name, const QString& schema, const Values&... values);
  void add(const QString& name, const QString& schema, const std::string& text, bool is_right = true);
  void add_outputs();
  void add_rare_outputs();
  void add_sessions();
  void add_moves();
  void add_presets();
  void add_rows(bool is_right);

  Program program_;
  std::map<QString, Checked> documents_;  // by name
  QStringList outputs_;                   // names of those that the programs begin with their kind
};

namespace {

/// All schemas, by the names of their files without endings.
std::map<QString, QJsonObject> schemas() {
  std::map<QString, QJsonObject> all;
  for (const QFileInfo& info : QFileInfo(schema_path({})).dir().entryInfoList({"*.schema.json"})) {
    QFile file(info.filePath());
    all[info.baseName()] =
        file.open(QIODevice::ReadOnly) ? QJsonDocument::fromJson(file.readAll()).object() : QJsonObject();
  }
  return all;
}

/// Calls `visit` for each object in a value.
template <class Visit>
void for_each_object(const QJsonValue& value, Visit visit) {
  if (value.isObject()) {
    visit(value.toObject());
    const QJsonObject object = value.toObject();
    for (const QString& key : object.keys()) {
      for_each_object(object[key], visit);
    }
  }
  for (const QJsonValue item : value.toArray()) {
    for_each_object(item, visit);
  }
}

/// A square of two triangles, which a split divides.
SplitPointer split_square() {
  MeshParts parts;
  parts.rest = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  parts.triangles = {{0, 1, 2}, {0, 2, 3}};
  add_links_along_edges(parts);
  return make_split(build_mesh(std::move(parts)),
                    {{SplitPoint::copy(0), SplitPoint::copy(2)}, {1}, {{4, 5, 3}}, {}, {}});
}

MeshPointer hexahedron() {
  MeshParts parts;
  for (int i = 0; i < 8; ++i) {
    parts.rest.emplace_back(i % 4 == 1 || i % 4 == 2, i % 4 / 2, i / 4);
  }
  parts.hexahedra = {{0, 1, 2, 3, 4, 5, 6, 7}};
  add_links_along_edges(parts);
  return build_mesh(std::move(parts));
}

SplitPointer split_hexahedron() {
  return make_split(hexahedron(),
                    {{SplitPoint::copy(0)}, {}, {}, {}, {}, {0}, {{8, 1, 3, 4}}, {{8, 1, 2, 3, 4, 5, 6, 7}}});
}

MeshPointer with_texture(const MeshPointer& mesh) {
  Texture texture;
  texture.size = {1, 1, 1};
  texture.channels = 4;
  texture.box = {Point(0, 0, 0), Point(1, 1, 0)};
  texture.texels = {1, 2, 3, 4};
  auto result = std::make_shared<Mesh>(*mesh);
  result->texture = std::make_shared<const Texture>(texture);
  return result;
}

/// A report that has what a short run does not have: refined references, series, and reasons.
report::Results rare_results() {
  report::Results results{.kind = report::ReportKind::suite};
  results.runs = {{report::Origin(), "1/2", {"bar"}}};
  results.settings = {{"young", 1.0}, {"lattice", "5x5x5"}};
  results.objects = {{.name = "bar",
                      .description = "a bar",
                      .series = "bars",
                      .reference = "FEM",
                      .notes = {"a note"},
                      .drags = {{}, {}}}};
  results.objects[0].drags[0].no_reference = "no solution";
  results.objects[0].drags[1].reference = Convergence{{{9, {}}, {25, 0.5}}, 1.5, true, "it converged"};
  report::Contestant contestant{.algorithm = Algorithm::exact, .calibrated = LinkSoftness(), .limit = 5};
  contestant.open_regions = true;
  results.rows = {
      {.drag = 0, .contestant = contestant, .refusal = "no grid"}, {.drag = 1, .contestant = contestant}, {}};
  for (const report::Figure* figure : report::every_figure()) {
    results.rows[1].set(*figure, 1.0);
  }
  results.rows[1].set(report::figures::later_ms, TimeSpread{2, 1, 3, 1, 3, 3});
  return results;
}

/// A ramp with growth.
report::Results rare_ramp() {
  report::Results ramp{.kind = report::ReportKind::ramp};
  for (const std::uint64_t width : {40, 60, 80}) {
    report::Row& row = ramp.rows.emplace_back(report::ramp_row(Algorithm::exact, {{double(width)}, 3}, 1));
    row.object = ramp.objects.size();
    row.drag = 0;
    report::ObjectInfo& grid = ramp.objects.emplace_back();
    grid.series = "square grid";
    grid.elements = width * width;
    grid.drags.emplace_back();
  }
  return ramp;
}

/// A session with one panel.
Session session_of(const MeshPointer& mesh) {
  Session session;
  session.mesh = mesh;
  session.panels.resize(1);
  return session;
}

Session session_of_file(const std::string& name) {
  Session session = session_of(made(MeshKind::cloth, {2, 2, 1}));
  session.mesh_file = name;
  return session;
}

Session session_with(const SplitPointer& split) {
  Session session = session_of(split->after());
  session.moves = {commands::Split{split}};
  return session;
}

/// A session that uses all features on a solid with turned axes, with a lesson.
Session turned_session() {
  Session session = session_on(made(MeshKind::tetra, {3, 3, 3}));
  Softness softness = *session.softness;
  softness.axes = RegionAxes(AxesKind::object, {0.1, 0.2, 0.3});
  session.softness = std::make_shared<const Softness>(softness);
  session.panels[0].positions.axes = RegionAxes(AxesKind::given, softness.axes.rotation());
  session.moves.insert(session.moves.begin(), commands::SetSoftness{session.softness});
  session.lesson.title = "A lesson";
  session.lesson.steps = {
      {"A step", "Text", 0, {Algorithm::exact, Algorithm::spiral}, 3, "plain", "surface", "softness", "drag"}};
  return session;
}

}  // namespace

/// Adds the output of a run of the program.
void SchemasTest::run(const QString& name, const QString& schema, const QString& file, const char* line) {
  const auto outcome = program_.run(line);
  QVERIFY2(outcome.code == 0, outcome.error);
  documents_[name] = {{schema, program_.path(file)}, true};
  outputs_.append(name);
}

/// Adds what core writes.
template <class... Values>
void SchemasTest::write(const QString& name, const QString& schema, const Values&... values) {
  std::ostringstream out;
  write_json(out, values...);
  add(name, schema, out.str());
  outputs_.append(name);
}

void SchemasTest::add(const QString& name, const QString& schema, const std::string& text, bool is_right) {
  const QString file = QString::number(documents_.size()) + ".document";
  program_.write(file, QByteArray::fromStdString(text));
  QVERIFY2(!documents_.contains(name), qPrintable(name));
  documents_[name] = {{schema, program_.path(file)}, is_right};
}

void SchemasTest::add_outputs() {
  for (const char* line : {"generate cloth 5x5 -o cloth.obj", "generate grid 4x4 -o grid.dat",
                           "generate line 5 -o line.dat", "generate tetra 2x2x2 -o tetra.msh"}) {
    QCOMPARE(program_.run(line).code, 0);
  }
  run("info", "info", "info.json", "info tetra.msh --json info.json");
  run("repair", "repair", "repair.json", "repair cloth.obj -o whole.obj --json repair.json");
  run("deform", "deform", "deform.json", "deform cloth.obj --algorithm spiral --by 12:2,1 --json deform.json");
  run("a split", "deform", "split.json",
      "deform tetra.msh --algorithm spiral --split 0.5,-1;0.5,2 --along 0,0,1 --by 0:-1 --json split.json");
  run("a handle of many", "deform", "many.json",
      "deform cloth.obj --algorithm exact --grab 11-13 --by 2,1 --rotate z:20 --json many.json");
  run("a handle that pins stop", "deform", "stopped.json",
      "deform line.dat --algorithm exact --stretch 1.25 --pin 0 --by 4:3 --json stopped.json");
  run("equilibrium", "deform", "rest.json",
      "deform cloth.obj --algorithm exact --pin 0 --by 24:1,1 --relaxation equilibrium --json rest.json");
  run("compare", "report", "exact/report.json",
      "compare grid.dat cloth.obj --repetitions 1 --algorithms natural-queue,original,exact -o exact");
  run("physics", "report", "physics/report.json",
      "compare cloth.obj --against physics --pins top --repetitions 1 --grow 0 --relax 0,equilibrium "
      "--calibrated off --algorithms exact,original,fem -o physics");
  run("calibrate", "report", "calibrate.json",
      "calibrate cloth.obj --pins top --drags 2 --evaluations 20 --name felt -o felt.json --json calibrate.json");
  run("ramp", "report", "ramp.json", "ramp --largest 36 --budget 3600 --algorithms spiral,exact --json ramp.json");
}

void SchemasTest::add_rare_outputs() {
  DeformSummary deform;
  deform.passes.resize(1);
  deform.passes[0].handle = {3};
  deform.passes[0].remark = "no convergence";
  deform.equilibrium.emplace().gap = 0.5;
  deform.inverted_cells = 2;
  write("a remark", "deform", deform);
  write("rare figures", "report", rare_results());
  write("growth of a ramp", "report", rare_ramp());
}

void SchemasTest::add_sessions() {
  const QDir root(sourceFile());
  int found = 0;
  for (const char* folder : {"meshes", "resources/lessons", "tests/files/sessions"}) {
    for (const QFileInfo& info : QDir(root.filePath(folder)).entryInfoList({"*.chainmail"})) {
      QFile file(info.filePath());
      QVERIFY(file.open(QIODevice::ReadOnly));
      const auto version = QJsonDocument::fromJson(file.readAll()).object()["version"].toInt();
      documents_[info.fileName()] = {{"session", info.filePath()}, version == 2};  // older ones have another schema
      found += version == 2 ? 1 : 0;
    }
  }
  QVERIFY(found >= 5);
  const auto add_session = [this](const QString& name, const Session& session) {
    add(name, "session", session_text(session));
  };
  add_session("a session of a mesh in a file", session_of_file("cloth.obj"));
  add_session("a session of a picture", session_on(with_texture(made(MeshKind::cloth, {4, 4, 1}))));
  add_session("a session of neighbours in their own order", session_of(dat("0 2 2 1\n1 2 0 2\n2 2 0 1\n", "3x1.dat")));
  add_session("a session of hexahedra", session_of(hexahedron()));
  add_session("a session with a split", session_with(split_square()));
  add_session("a session with a split of cells", session_with(split_hexahedron()));
  add_session("a session with a frame and a lesson", turned_session());
}

void SchemasTest::add_moves() {
  const SplitPointer split = split_square();
  const Softness softness{{}, {{0, {}}}, EnergyKind::axial, RegionAxes(AxesKind::given, {0, 0, 1})};
  commands::Drag turn{{1, 2, 0}};
  turn.relative = true;
  turn.rotation = {Point(0, 0, 1), 20};
  const auto counts = std::make_shared<commands::SliceCounts>(2);
  counts->note(0, Algorithm::exact, 7);
  counts->note(1, Algorithm::generalized, 0);
  const std::vector<Command> moves{
      commands::Pin{{0}},
      commands::SetSoftness{softness},
      commands::Cut{{0}},
      commands::Uncut{{0}},
      commands::Grab{{2, 3}},
      turn,
      commands::Release{},
      commands::Unpin{{0}},
      commands::Grab{1},
      commands::Drag{{1, 2, 0}},
      commands::Reset{},
      commands::Relax{3, 0.5, RelaxationScheme::link},
      commands::Relax{200, 1, RelaxationScheme::equilibrium, 0.001},
      commands::Relax{200, 1, RelaxationScheme::equilibrium, 0, true},
      commands::Relaxed{RelaxationScheme::mean, 1, commands::Relaxed::Start::awake, counts},
      commands::Relaxed{RelaxationScheme::equilibrium, 1, commands::Relaxed::Start::goes_on, counts, 0, true},
      commands::Split{split}};
  std::ostringstream out;
  write_moves(out, moves, *split->after());
  add("all moves", "moves", out.str());
}

void SchemasTest::add_presets() {
  documents_["a calibrated preset"] = {{"preset", program_.path("felt.json")}, true};
  std::vector<SoftnessPreset> presets;
  for (const BuiltInPreset& preset : built_in_presets()) {
    presets.push_back({std::string(preset.name), preset.softness});
  }
  const auto add_preset = [this](const QString& name, std::span<const SoftnessPreset> all, bool is_right) {
    std::ostringstream out;
    write_presets(out, all);
    add(name, "preset", out.str(), is_right);
  };
  add_preset("presets", presets, true);
  // The limits are those of the parameters.
  for (const auto& [parameter, value] : softness_numbers) {
    const QString name = QString::fromUtf8(parameter->name.data(), qsizetype(parameter->name.size()));
    for (const double limit : {parameter->lowest, parameter->highest}) {
      const double beyond = std::nextafter(limit, limit == parameter->lowest ? -1e9 : 1e99);
      SoftnessPreset preset{"felt", {}};
      preset.softness.*value = limit;
      add_preset(name + " " + QString::number(limit), std::array{preset}, true);
      if (limit != parameters::no_highest) {
        preset.softness.*value = beyond;
        add_preset(name + " beyond " + QString::number(limit), std::array{preset}, false);
      }
    }
  }
}

/// Adds documents that a person may write.
void SchemasTest::add_rows(bool is_right) {
  const auto command = [&](const char* text) {
    add(text, "moves", R"({"version": 1, "commands": [)" + std::string(text) + "]}", is_right);
  };
  if (is_right) {
    command(R"({"do": "relax", "sweeps": 3})");
    command(R"({"do": "drag", "rotate": {"axis": [0, 0, 1], "degrees": 5}})");
    command(R"({"do": "softness", "compression": 1, "stretch": 1, "shear": 0, "links": [[0, 1, 1, 1, 0]]})");
    command(R"({"do": "softness", "compression": 1, "stretch": 1, "shear": 0, "frame": {"kind": "object"}})");
    return;
  }
  command(R"({"do": "jump"})");
  command(R"({"element": 3})");
  command(R"({"do": "grab", "elment": 3})");
  command(R"({"do": "grab", "element": -1})");
  command(R"({"do": "grab", "element": 1.5})");
  command(R"({"do": "grab", "element": 1, "elements": [2]})");
  command(R"({"do": "grab"})");
  command(R"({"do": "drag"})");
  command(R"({"do": "drag", "target": [1, 2]})");
  command(R"({"do": "drag", "target": [1, 2, 3], "by": [1, 2, 3]})");
  command(R"({"do": "cut", "links": [[0, 1, 2]]})");
  command(R"({"do": "relax"})");
  command(R"({"do": "relax", "sweeps": 3, "until": 0.1})");
  command(R"({"do": "relax", "sweeps": 3, "step": 0})");
  command(R"({"do": "relax", "sweeps": 3, "scheme": "means"})");
  command(R"({"do": "softness", "compression": 1, "stretch": 1})");
  command(R"({"do": "softness", "compression": 1, "stretch": 1, "shear": 0, "links": [[0, 1, 1, 1, 0, 1]]})");
  command(R"({"do": "softness", "compression": 1, "stretch": 1, "shear": 0, "frame": {"kind": "given"}})");
  add("another version of moves", "moves", R"({"version": 5, "commands": []})", false);
  add("a preset without a name", "preset", R"({"version": 1, "presets": [{"name": " "}]})", false);
  Session empty = session_of_file("cloth.obj");
  empty.panels.clear();
  add("a session without panels", "session", session_text(empty), false);
  add("a session that leaves its folder", "session", session_text(session_of_file("../cloth.obj")), false);
  const auto session = [&](const char* name, const std::string& before, const std::string& after) {
    std::string text = session_text(session_of(made(MeshKind::cloth, {2, 2, 1})));
    const auto at = text.find(before);
    QVERIFY2(at != std::string::npos, name);
    add(name, "session", text.replace(at, before.size(), after), false);
  };
  session("a session of another version", "\"version\": 2", "\"version\": 3");
  session("a session without links", "\"links\"", "\"counts\"");
  session("a session with a file and a mesh", "\"elements\": 4", "\"elements\": 4, \"file\": \"a.obj\"");
  session("a session of no elements", "\"elements\": 4", "\"elements\": 0");
}

void SchemasTest::initTestCase() {
  add_outputs();
  add_rare_outputs();
  add_sessions();
  add_moves();
  add_presets();
  add_rows(true);
  add_rows(false);
  QList<SchemaDocument> all;
  for (const auto& [name, one] : documents_) {
    all.append(one.document);
  }
  qsizetype i = 0;
  for (const auto checks = check_schemas(all); auto& [name, one] : documents_) {
    one.check = checks[i++];
  }
}

void SchemasTest::outputs_begin_with_their_kind_data() {
  QTest::addColumn<QString>("path");
  QTest::addColumn<QByteArray>("begin");
  for (const QString& name : outputs_) {
    const auto& [schema, path] = documents_[name].document;
    QTest::newRow(qPrintable(name)) << path
                                    << "{\n  \"kind\": \"chainmail " + schema.toUtf8() +
                                           "\",\n  \"schema_version\": " + (schema == "report" ? "2" : "1") + ",\n  ";
  }
}

void SchemasTest::outputs_begin_with_their_kind() {
  QFETCH(QString, path);
  QFETCH(QByteArray, begin);
  QFile file(path);
  QVERIFY(file.open(QIODevice::ReadOnly));
  QCOMPARE(file.read(begin.size()), begin);
}

void SchemasTest::documents_follow_their_schemas_data() {
  QTest::addColumn<QString>("fault");
  QTest::addColumn<QStringList>("accepted");
  for (const auto& [name, one] : documents_) {
    if (one.is_right) {
      QTest::newRow(qPrintable(name)) << one.check.fault << one.check.accepted;
    }
  }
}

/// A document follows its schema. With one misspelt member or one value of another type, it no longer does.
void SchemasTest::documents_follow_their_schemas() {
  QFETCH(QString, fault);
  QFETCH(QStringList, accepted);
  QCOMPARE(fault, QString());
  QCOMPARE(accepted, QStringList());
}

void SchemasTest::wrong_documents_are_refused_data() {
  QTest::addColumn<QString>("fault");
  for (const auto& [name, one] : documents_) {
    if (!one.is_right) {
      QTest::newRow(qPrintable(name)) << one.check.fault;
    }
  }
}

void SchemasTest::wrong_documents_are_refused() {
  QFETCH(QString, fault);
  QVERIFY(!fault.isEmpty() && !fault.startsWith("not checked"));
}

void SchemasTest::every_schema_has_a_document() {
  std::set<QString> checked{"case", "answer"};  // test_peers checks them
  for (const auto& [name, one] : documents_) {
    checked.insert(one.document.schema);
  }
  std::set<QString> present;
  for (const auto& [name, schema] : schemas()) {
    present.insert(name);
  }
  QVERIFY(present == checked);
}

/// No schema accepts members that it does not name, except in the state of the window.
void SchemasTest::every_object_is_closed() {
  for (const auto& [name, schema] : schemas()) {
    for_each_object(schema, [&](const QJsonObject& object) {
      if (object["type"] == "object" && object.contains("properties")) {
        QVERIFY2(object["additionalProperties"] == QJsonValue(false), qPrintable(name));
      }
    });
  }
}

CHAINMAIL_TEST(SchemasTest)

}  // namespace chainmail::test_schemas

#include "test_schemas.moc"
