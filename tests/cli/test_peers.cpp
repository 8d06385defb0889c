#include <QJsonArray>
#include <QJsonDocument>
#include <QProcess>
#include <functional>

#include "cli/chainmail_program.h"
#include "cli/json_schemas.h"
#include "files/results/peer_json.h"
#include "folders.h"
#include "program.h"
#include "report/run/suite_experiments.h"

namespace chainmail::test_peers {

using namespace chainmail::test;

using Change = std::function<void(QJsonObject&)>;

/// Tests `chainmail compare --judge`, with the cases in tests/peers.
class PeersTest : public QObject {
  Q_OBJECT

 private slots:
  void init();
  void cases_follow_their_schema_data();
  void cases_follow_their_schema();
  void the_bar_is_that_of_the_suite();
  void the_example_has_the_error_of_nothing();
  void the_reference_has_none();
  void errors_and_times_are_those_of_the_answer();
  void wrong_answers_are_refused_data();
  void wrong_answers_are_refused();
  void wrong_cases_are_refused_data();
  void wrong_cases_are_refused();
  void a_case_in_which_nothing_moves_is_refused();
  void wrong_usage_data();
  void wrong_usage();

 private:
  QJsonObject answer(const char* solver) const;
  void write(const char* name, const QJsonObject& json) const { program_->write(name, QJsonDocument(json).toJson()); }

  std::unique_ptr<Program> program_;
  QJsonObject case_;
};

/// Each test has the case as case.json in its folder.
void PeersTest::init() {
  program_ = std::make_unique<Program>();
  QFile file(sourceFile("tests/peers/bar-bend.json"));
  QVERIFY(file.open(QIODevice::ReadOnly));
  case_ = QJsonDocument::fromJson(file.readAll()).object();
  write("case.json", case_);
}

/// An answer in which all elements are where the reference has them.
QJsonObject PeersTest::answer(const char* solver) const {
  return {{"kind", "chainmail answer"},
          {"schema_version", 1},
          {"solver", solver},
          {"case", case_["name"]},
          {"positions", case_["reference"]}};
}

void PeersTest::cases_follow_their_schema_data() {
  QTest::addColumn<QString>("name");
  for (const QString& name : QDir(sourceFile("tests/peers")).entryList({"*.json"})) {
    QTest::newRow(qPrintable(name)) << name;
  }
}

void PeersTest::cases_follow_their_schema() {
  QFETCH(const QString, name);
  const auto check = check_schemas({{"case", sourceFile("tests/peers/") + name}}).front();
  QCOMPARE(check.fault, QString());
  QCOMPARE(check.accepted, QStringList());
}

/// `compare --cases` writes the same object, moves and reference again.
void PeersTest::the_bar_is_that_of_the_suite() {
  using namespace chainmail::report;
  const auto all = suite_experiments();
  const Case object = std::ranges::find(all, "time-bar", &SuiteExperiment::name)->cases({}).front();
  const RecordedMoves& drag = object.drags.front();
  const PeerCase now = peer_case(object, drag, DragReferences(object, suite_reference()).at_end(drag));
  const PeerCase written = read_peer_case(source_file("tests/peers/bar-bend.json"));
  QCOMPARE(now.name, written.name);
  QVERIFY(now.mesh->tetrahedra == written.mesh->tetrahedra && now.mesh->rest == written.mesh->rest);
  QVERIFY(now.pins == written.pins && now.handle == written.handle);
  QCOMPARE(now.moves.size(), written.moves.size());
  const auto are_close = [](const std::vector<Point>& a, const std::vector<Point>& b) {
    return std::ranges::equal(a, b, [](const Point& one, const Point& other) { return (one - other).norm() < 1e-6; });
  };
  for (std::size_t i = 0; i < now.moves.size(); ++i) {
    QVERIFY(are_close(now.moves[i], written.moves[i]));
  }
  // A slower machine refines the reference less within its time.
  QVERIFY(now.reference_change != written.reference_change || are_close(now.reference, written.reference));
}

/// The null model is exactly as wrong as the reference moves, so its relative error is 1.
void PeersTest::the_example_has_the_error_of_nothing() {
  QProcess python;
  python.setWorkingDirectory(program_->path(""));
  python.start("python3", {sourceFile("tests/peers/example.py"), "case.json", "answer.json"});
  QVERIFY(python.waitForFinished(60'000));
  QVERIFY2(python.exitCode() == 0, python.readAllStandardError());
  QCOMPARE(check_schemas({{"answer", program_->path("answer.json")}}).front().fault, QString());
  const auto outcome = program_->run("compare --judge case.json answer.json");
  QVERIFY2(outcome.code == 0 && outcome.error.isEmpty(), outcome.error);
  QVERIFY2(QRegularExpression("nothing but the handle moves +1 ").match(outcome.out).hasMatch(), outcome.out);
}

void PeersTest::the_reference_has_none() {
  write("answer.json", answer("perfect"));
  const auto outcome = program_->run("compare --judge case.json answer.json");
  const QString bound = QString::number(case_["reference_change"].toDouble(), 'g', 3);
  QVERIFY2(QRegularExpression("perfect +below " + bound + " ").match(outcome.out).hasMatch(), outcome.out);
}

/// The error is that of a formula: the RMS distance over the RMS displacement of the elements that are free.
void PeersTest::errors_and_times_are_those_of_the_answer() {
  const auto coordinate = [&](const char* list, int element, int k) {
    return case_[list].toArray()[element].toArray()[k].toDouble();
  };
  QSet<int> held;
  for (const char* list : {"pins", "handle"}) {
    for (const QJsonValue element : case_[list].toArray()) {
      held.insert(element.toInt());
    }
  }
  QJsonArray positions = case_["reference"].toArray();
  double apart = 0, way = 0;
  for (int e = 0; e < positions.size(); ++e) {
    if (!held.contains(e)) {
      const double off = e % 2 == 0 ? 0.4 : -0.1;
      positions[e] =
          QJsonArray{coordinate("reference", e, 0), coordinate("reference", e, 1) + off, coordinate("reference", e, 2)};
      apart += off * off;
      for (int k = 0; k < 3; ++k) {
        way += std::pow(coordinate("reference", e, k) - coordinate("positions", e, k), 2);
      }
    }
  }
  QJsonObject json = answer("off");
  json["positions"] = positions;
  QJsonArray times{50};
  for (int move = 1; move < case_["moves"].toArray().size(); ++move) {
    times.append(move % 2 == 0 ? 1 : 3);
  }
  json["moves_ms"] = times;
  json["grab_ms"] = 7;
  write("answer.json", json);
  const auto outcome = program_->run("compare --judge case.json answer.json");
  const QString error = QString::number(std::sqrt(apart / way), 'g', 3);
  // 23 later moves: 12 of 3 ms and 11 of 1 ms.
  QVERIFY2(QRegularExpression("off +" + error + " +50 +2.04 +7 ").match(outcome.out).hasMatch(), outcome.out);
}

void PeersTest::wrong_answers_are_refused_data() {
  QTest::addColumn<Change>("change");
  QTest::addColumn<QString>("says");
  const auto row = [](const char* name, const char* says, const Change& change) {
    QTest::newRow(name) << change << QString(says);
  };
  row("another kind", "it is not a chainmail answer", [](QJsonObject& json) { json["kind"] = "chainmail case"; });
  row("another case", "it answers another case, x", [](QJsonObject& json) { json["case"] = "x"; });
  row("too few positions", "it has positions of 1 elements", [](QJsonObject& json) {
    json["positions"] = QJsonArray{QJsonArray{0, 0, 0}};
  });
  row("two coordinates", "a position does not have three coordinates", [](QJsonObject& json) {
    json["positions"] = QJsonArray{QJsonArray{0, 0}};
  });
  row("a time below 0", "a time is below 0", [](QJsonObject& json) { json["grab_ms"] = -1; });
  row("the handle stays", "of the handle is not at its place", [](QJsonObject& json) { json["positions"] = "rest"; });
}

void PeersTest::wrong_answers_are_refused() {
  QFETCH(const Change, change);
  QFETCH(const QString, says);
  QJsonObject json = answer("wrong");
  change(json);
  if (json["positions"] == "rest") {
    json["positions"] = case_["positions"];
  }
  write("answer.json", json);
  const auto outcome = program_->run("compare --judge case.json answer.json");
  QCOMPARE(outcome.code, 2);
  QVERIFY2(is_one_sentence(outcome), outcome.error);
  QVERIFY2(outcome.error.contains(says.toUtf8()), outcome.error);
}

void PeersTest::wrong_cases_are_refused_data() {
  QTest::addColumn<Change>("change");
  QTest::addColumn<QString>("says");
  const auto row = [](const char* name, const char* says, const Change& change) {
    QTest::newRow(name) << change << QString(says);
  };
  row("an id that is too large", "an id is not a whole number",
      [](QJsonObject& json) { json["pins"] = QJsonArray{1'000'000}; });
  row("no handle", "'handle' or 'moves' is empty", [](QJsonObject& json) {
    json["handle"] = QJsonArray();
    json["moves"] = QJsonArray{QJsonArray()};
  });
  row("no cells", "'cells' is empty", [](QJsonObject& json) { json["cells"] = QJsonArray(); });
  row("a short reference", "'reference' does not have a position for each element", [](QJsonObject& json) {
    json["reference"] = QJsonArray{QJsonArray{0, 0, 0}};
  });
  row("Poisson's ratio of 1", "", [](QJsonObject& json) {
    QJsonObject material = json["material"].toObject();
    material["poisson"] = 1;
    json["material"] = material;
  });
}

void PeersTest::wrong_cases_are_refused() {
  QFETCH(const Change, change);
  QFETCH(const QString, says);
  write("answer.json", answer("right"));
  change(case_);
  write("case.json", case_);
  const auto outcome = program_->run("compare --judge case.json answer.json");
  QCOMPARE(outcome.code, 2);
  QVERIFY2(is_one_sentence(outcome) && outcome.error.startsWith("chainmail: case.json"), outcome.error);
  QVERIFY2(outcome.error.contains(says.toUtf8()), outcome.error);
}

/// Errors are relative to the way of the reference.
void PeersTest::a_case_in_which_nothing_moves_is_refused() {
  write("answer.json", answer("right"));
  case_["reference"] = case_["positions"];
  write("case.json", case_);
  const auto outcome = program_->run("compare --judge case.json answer.json");
  QCOMPARE(outcome.code, 2);
  QVERIFY2(is_one_sentence(outcome) && outcome.error.contains("its error is not a number"), outcome.error);
}

void PeersTest::wrong_usage_data() {
  QTest::addColumn<QString>("line");
  QTest::addColumn<QString>("where");
  const auto row = [](const char* line, const char* where) { QTest::newRow(line) << QString(line) << QString(where); };
  row("compare --judge", "--judge");
  row("compare --judge case.json", "--judge");
  row("compare --judge case.json answer.json --relax 3", "--relax");
  row("compare --cases case.json -o out", "MESH");
}

void PeersTest::wrong_usage() {
  QFETCH(const QString, line);
  QFETCH(const QString, where);
  check_refused(*program_, qPrintable(line), where);
}

CHAINMAIL_TEST(PeersTest)

}  // namespace chainmail::test_peers

#include "test_peers.moc"
