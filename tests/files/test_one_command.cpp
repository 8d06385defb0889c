#include <QtTest>
#include <set>

#include "files/schema/command_schemas.h"
#include "files/session/moves.h"
#include "files/support.h"
#include "program.h"

namespace chainmail::test_one_command {

using namespace chainmail::test;

/// A command is a struct with a name, and one list of its members. Reading, writing and the schema include a new one.
class OneCommandTest : public QObject {
  Q_OBJECT

 private slots:
  void it_is_written_and_read();
  void it_is_checked_data();
  void it_is_checked();
  void it_has_a_schema();
  void members_that_go_together_have_a_schema_each();
  void every_command_of_files_is_in_the_schema();
};

/// A command that files of this project do not have.
struct Knock {
  static constexpr std::string_view name = "knock", help = "knocks at elements";
  std::vector<ElementId> elements;
  Point along = Point::Zero();
  std::vector<std::uint32_t> times;  // may be left out
};
void members(auto& io, Knock& one) {
  io.elements("elements", one.elements);
  io.point("along", one.along, "direction");
  io.numbers("times", one.times, "how often");
}

// One of them is not for files.
using Commands = std::variant<commands::Grab, commands::SetAlgorithm, Knock, commands::Relax>;

static std::vector<Commands> read(const std::string& commands) {
  return MovesReader("moves", made(MeshKind::line, {4, 1, 1}), link_energy)
      .read<Commands>(R"({"version": 1, "commands": [)" + commands + "]}", "m.json", {});
}
static std::vector<schema::Json> schemas_of(std::string_view name) {
  std::vector<schema::Json> found;
  const schema::Json all = schema::commands_of(std::type_identity<Commands>());
  for (const schema::Json& one : all["anyOf"]) {
    if (one["properties"]["do"]["const"] == schema::Json(name)) {
      found.push_back(one);
    }
  }
  return found;
}

void OneCommandTest::it_is_written_and_read() {
  const auto line = made(MeshKind::line, {4, 1, 1});
  MovesWriter writer(*line);
  const auto written = [&](const Commands& one) { return std::visit(writer, one).dump(); };
  const std::string whole = R"({"do":"knock","elements":[3,1],"along":[0.5,1.0,-2.0],"times":[7]})",
                    shorter = R"({"do":"knock","elements":[],"along":[0.0,0.0,0.0]})";
  QCOMPARE(written(Knock{{3, 1}, Point(0.5, 1, -2), {7}}), whole);
  QCOMPARE(written(Knock()), shorter);
  const auto moves = read(whole + "," + shorter + R"(, {"do": "grab", "element": 2})");
  QCOMPARE(moves.size(), std::size_t{3});
  const auto& knock = std::get<Knock>(moves[0]);
  QCOMPARE(knock.elements, (std::vector<ElementId>{3, 1}));
  QVERIFY(knock.along == Point(0.5, 1, -2) && knock.times == std::vector<std::uint32_t>{7});
  QVERIFY(std::get<Knock>(moves[1]).times.empty());
  QCOMPARE(std::get<commands::Grab>(moves[2]).elements, std::vector<ElementId>{2});
}

void OneCommandTest::it_is_checked_data() {
  QTest::addColumn<QString>("command");
  QTest::addColumn<QString>("error");
  const auto row = [](const char* command, const char* error) {
    QTest::newRow(command) << QString::fromUtf8(command) << QString::fromUtf8(error);
  };
  row(R"({"do": "knock", "elements": [4], "along": [1, 0, 0]})", "4");
  row(R"({"do": "knock", "elements": [1]})", "along");
  row(R"({"do": "knock", "elements": [1], "along": [1, 0, 0], "loud": 1})", "loud");
  row(R"({"do": "pin", "elements": [1]})", "grab, knock or relax");
}

void OneCommandTest::it_is_checked() {
  QFETCH(QString, command);
  QFETCH(QString, error);
  const QString text = error_of([&] { read(command.toStdString()); });
  QVERIFY2(text.startsWith("moves: command 0: ") && text.contains(error), qPrintable(text));
}

void OneCommandTest::it_has_a_schema() {
  const auto schemas = schemas_of("knock");
  QCOMPARE(schemas.size(), std::size_t{1});
  QCOMPARE(schemas[0]["description"].get<std::string>(), std::string(Knock::help));
  QCOMPARE(schemas[0]["required"].dump(), std::string(R"(["do","elements","along"])"));
  QCOMPARE(schemas[0]["properties"].size(), std::size_t{4});
  QCOMPARE(schemas[0]["properties"]["along"]["description"].get<std::string>(), std::string("direction"));
  QVERIFY(schemas[0]["additionalProperties"] == schema::Json(false));
}

void OneCommandTest::members_that_go_together_have_a_schema_each() {
  const auto schemas = schemas_of("grab");
  QCOMPARE(schemas.size(), std::size_t{2});
  QCOMPARE(schemas[0]["required"].dump(), std::string(R"(["do","elements"])"));
  QCOMPARE(schemas[1]["required"].dump(), std::string(R"(["do","element"])"));
  std::set<std::string> drags;
  std::vector<schema::Json> all;
  schema::add_command<commands::Drag>(all);
  for (const schema::Json& one : all) {
    drags.insert(one["required"].dump());
  }
  QCOMPARE(all.size(), std::size_t{5});
  QVERIFY((drags == std::set<std::string>{R"(["do","target"])", R"(["do","by"])", R"(["do","rotate"])",
                                          R"(["do","target","rotate"])", R"(["do","by","rotate"])"}));
}

/// The names of the commands that reading knows, in its error, and those of the schema.
void OneCommandTest::every_command_of_files_is_in_the_schema() {
  std::set<std::string> names;
  const schema::Json all = schema::commands_of(std::type_identity<Command>());
  for (const schema::Json& one : all["anyOf"]) {
    names.insert(one["properties"]["do"]["const"].get<std::string>());
  }
  QCOMPARE(names.size(), std::size_t{12});
  const std::string unknown = R"({"version": 1, "commands": [{"do": "jump"}]})";
  const QString text = error_of([&] { read_moves(unknown, "m.json", made(MeshKind::line, {4, 1, 1})); });
  for (const std::string& name : names) {
    QVERIFY2(text.contains(QString::fromStdString(name)), qPrintable(text));
  }
}

CHAINMAIL_TEST(OneCommandTest)

}  // namespace chainmail::test_one_command

#include "test_one_command.moc"
