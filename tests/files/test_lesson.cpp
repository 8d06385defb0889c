#include <QtTest>
#include <filesystem>

#include "files/mesh/open_mesh.h"
#include "files/session_support.h"
#include "files/text/limits.h"
#include "folders.h"
#include "program.h"

namespace chainmail::test_lesson {

using namespace chainmail::test;
namespace fs = std::filesystem;

namespace {

/// Opens the samples by name, as the window does.
MeshPointer open_sample(const std::string& name, std::uint32_t /*across*/, const Progress& progress) {
  return open_mesh(source_file("meshes") / name, {}, progress).mesh;
}

/// Returns a session with five moves and a lesson that uses every member.
Session lesson_session() {
  Session session = session_on(generate({MeshKind::grid, {3, 3, 1}, 1, {}}));
  session.lesson = {"a \"title\" ∆",
                    {{"first", "text of it", 0, {}, {}, {}, {}, {}, {}},
                     {"second",
                      "b",
                      3,
                      {Algorithm::spiral, Algorithm::exact, Algorithm::linear_fem},
                      7,
                      "violation",
                      "both",
                      "propagation",
                      "cut"},
                     {"third", "c", 5, {}, 0, {}, {}, {}, {}}}};
  return session;
}

/// Returns the complete example in the manual's page on sessions.
std::string example() {
  const std::string page = file_text(source_file("resources/manual/sessions.md"));
  const auto from = page.find("```json\n") + 8;
  return page.substr(from, page.find("```", from) - from);
}

}  // namespace

/// Lessons: sessions with captions. They read back as they were written, and a damaged one is refused with the step,
/// the problem and what to do.
class LessonTest : public QObject {
  Q_OBJECT

 private slots:
  void what_is_written_reads_back();
  void a_session_without_lesson_stays_the_same();
  void the_example_in_the_manual_is_a_lesson();
  void damaged_steps_are_refused_data();
  void damaged_steps_are_refused();
  void texts_are_one_line();
  void long_texts_are_refused();
  void a_lesson_has_steps();
  void a_mesh_may_be_named();
  void names_that_lead_elsewhere_are_refused_data();
  void names_that_lead_elsewhere_are_refused();
  void a_lesson_goes_with_its_moves();
  void a_lesson_may_have_no_moves();
};

void LessonTest::what_is_written_reads_back() {
  const Session session = lesson_session();
  const Session again = parse_session(session_text(session), "a.chainmail");
  QVERIFY(again.lesson == session.lesson);
  QCOMPARE(session_text(again), session_text(session));
}

void LessonTest::a_session_without_lesson_stays_the_same() {
  Session session = lesson_session();
  session.lesson = {};
  QVERIFY(!QString::fromStdString(session_text(session)).contains("lesson"));
  QVERIFY(parse_session(session_text(session), "a.chainmail").lesson.steps.empty());
}

void LessonTest::the_example_in_the_manual_is_a_lesson() {
  const Session session = parse_session(example(), "manual.chainmail", {}, open_sample);
  QCOMPARE(session.mesh->element_count(), 9U);
  QCOMPARE(session.lesson.steps.size(), std::size_t{2});
  QCOMPARE(session.lesson.steps[1].until, session.moves.size());
}

void LessonTest::damaged_steps_are_refused_data() {
  QTest::addColumn<QString>("passage");
  QTest::addColumn<QString>("other");
  QTest::addColumn<QString>("said");
  const auto row = [](const char* name, const char* passage, const char* other, const char* said) {
    QTest::newRow(name) << QString(passage) << QString(other) << "a.chainmail: lesson" + QString(said);
  };
  row("no steps", "\"steps\": [", "\"steps\": [], \"else\": [", ": 'else' is not a known key");
  row("beyond the moves", "\"until\":5", "\"until\":6",
      ": step 3: 'until' is 6, but the session has 5 recorded moves; write a whole number from 0 to 5");
  row("negative", "\"until\":0", "\"until\":-1", ": step 1: 'until' is -1, but the session has 5 recorded moves");
  row("fraction", "\"until\":3", "\"until\":2.5", ": step 2: 'until' is 2.5, but the session has 5 recorded moves");
  row("backwards", "\"until\":5", "\"until\":2",
      ": step 3: 'until' is 2, but the step before ends at 3; write 3 or more");
  row("no position", "\"until\":5", "\"dock\":\"x\"", ": step 3: 'until' is missing");
  row("no text", "\"text\":\"b\"", "\"text\":7", ": step 2: 'text' is not a text");
  row("empty text", "\"text\":\"b\"", "\"text\":\"\"", ": step 2: 'text' is empty; write what the reader shall see");
  row("unknown key", "\"dock\"", "\"duck\"", ": step 2: 'duck' is not a known key");
  row("unknown algorithm", "[\"spiral\"", "[\"spirol\"",
      ": step 2: the algorithm \"spirol\" is not known; use one that 'chainmail deform --help' lists");
  row("algorithm that is no text", "[\"spiral\"", "[3", ": step 2: the algorithm 3 is not known");
  row("unfit algorithm", "[\"spiral\"", "[\"bem\"", ": step 2: BEM: it works only on closed surfaces");
  row("too few panels", "[\"spiral\",\"exact\",\"fem\"]", "[\"spiral\"]",
      ": step 2: 'algorithms' has 1 names; give one for each of 2 to 4 panels");
  row("too many panels", "[\"spiral\"", "[\"exact\",\"exact\",\"exact\"", ": step 2: 'algorithms' has 5 names");
  row("half a candidate", "\"candidate\":7", "\"candidate\":0.5", ": step 2: 'candidate' is not a whole number");
  row("step that is a number", "{\"title\":\"third\",\"text\":\"c\",\"until\":5,\"candidate\":0}", "4",
      ": step 3: it is not an object; write it in { }");
}

void LessonTest::damaged_steps_are_refused() {
  QFETCH(QString, passage);
  QFETCH(QString, other);
  QFETCH(QString, said);
  const QString good = QString::fromStdString(session_text(lesson_session()));
  QVERIFY2(good.contains(passage), qPrintable(good.mid(good.indexOf("\"lesson\""), 600)));
  const std::string text = QString(good).replace(passage, other).toStdString();
  const QString error = error_of([&] { parse_session(text, "a.chainmail"); });
  QVERIFY2(error.startsWith(said), qPrintable(error));
  QVERIFY2(error.contains("; "), qPrintable(error));  // says what to do
}

/// Line ends would fill the window.
void LessonTest::texts_are_one_line() {
  Session session = lesson_session();
  session.name = "two\nlines";
  session.lesson.title = "a\r\nb";
  session.lesson.steps[0].text = "c\u2028d";
  const Session again = parse_session(session_text(session), "a.chainmail");
  QCOMPARE(again.name, std::string("two lines"));
  QCOMPARE(again.lesson.title, std::string("a  b"));
  QCOMPARE(again.lesson.steps[0].text, std::string("c d"));
  session.lesson.title = std::string(127, '\n');
  QCOMPARE(error_of([&] { parse_session(session_text(session), "a.chainmail"); }),
           QString("a.chainmail: lesson: 'title' is empty; write what the reader shall see"));
}

/// The window lays them out, and shortens a title that is too wide.
void LessonTest::long_texts_are_refused() {
  const auto error = [](const std::string& title, const std::string& of_step, const std::string& text) {
    Session session = lesson_session();
    session.lesson.title = title;
    session.lesson.steps[0].title = of_step;
    session.lesson.steps[0].text = text;
    return error_of([&] { parse_session(session_text(session), "a.chainmail"); });
  };
  const std::string name(limits::name_bytes, 'x'), text(limits::caption_bytes, 'y');
  QCOMPARE(error(name, name, text), QString());
  QCOMPARE(error(name + "x", name, text), QString("a.chainmail: lesson: 'title' has 256 bytes; use at most 255"));
  QCOMPARE(error(name, name + "x", text),
           QString("a.chainmail: lesson: step 1: 'title' has 256 bytes; use at most 255"));
  QCOMPARE(error(name, name, text + "y"),
           QString("a.chainmail: lesson: step 1: 'text' has 4097 bytes; use at most 4096"));
  // Neither does an error repeat what is long.
  std::string long_name = session_text(lesson_session());
  long_name.insert(long_name.rfind("\"spiral\"") + 1, std::string(1'000'000, 'z'));
  const QString said = error_of([&] { parse_session(long_name, "a.chainmail"); });
  QVERIFY(said.contains("the algorithm \"zzz") && said.size() < 1000);
}

void LessonTest::a_lesson_has_steps() {
  const QString text = QString::fromStdString(example());
  const auto from = text.indexOf("\"steps\": [") + 10, end = text.indexOf("]},\n \"mesh\"");  // between the brackets
  QVERIFY(end > from);
  const std::string empty = QString(text).replace(from, end - from, "").toStdString();
  QCOMPARE(error_of([&] { parse_session(empty, "a.chainmail", {}, open_sample); }),
           QString("a.chainmail: lesson: it has 0 steps; give 1 to 1000"));
}

void LessonTest::a_mesh_may_be_named() {
  const std::string text = example();
  const QString error = error_of([&] { parse_session(text, "a.chainmail"); });
  QCOMPARE(error, QString("a.chainmail: mesh: it is in another file, '3x3.dat'; open the session in the workbench and "
                          "save it there"));
  std::string asked;
  const auto open = [&](const std::string& name, std::uint32_t across, const Progress& progress) {
    asked = name + " " + std::to_string(across);
    return open_sample("3x3.dat", across, progress);
  };
  const QString with = QString::fromStdString(text).replace("\"3x3.dat\"", "\"a.png\", \"across\": 12");
  parse_session(with.toStdString(), "a.chainmail", {}, open);
  QCOMPARE(asked, std::string("a.png 12"));
}

void LessonTest::names_that_lead_elsewhere_are_refused_data() {
  QTest::addColumn<QString>("name");
  for (const char* name : {"", "/etc/passwd", "../a.dat", "..", ".a", "b/a.dat", "b\\\\a.dat"}) {
    QTest::newRow(name) << QString(name);
  }
}

void LessonTest::names_that_lead_elsewhere_are_refused() {
  QFETCH(QString, name);
  const std::string text = QString::fromStdString(example()).replace("3x3.dat", name).toStdString();
  const QString error = error_of([&] { parse_session(text, "a.chainmail", {}, open_sample); });
  QVERIFY2(error.startsWith("a.chainmail: mesh: 'file' is not the plain name of a file; "), qPrintable(error));
}

/// A session with too many moves is saved without them, and so without captions that count them.
void LessonTest::a_lesson_goes_with_its_moves() {
  Session session = lesson_session();
  session.moves.resize(limits::session_moves + 1, commands::Drag{});
  const Session again = parse_session(session_text(session), "a.chainmail");
  QVERIFY(again.moves.empty());
  QVERIFY(again.lesson.steps.empty());
}

/// Captions may be about an object that nobody moves yet.
void LessonTest::a_lesson_may_have_no_moves() {
  Session session = lesson_session();
  session.moves.clear();
  session.moves_done = 0;
  for (LessonStep& step : session.lesson.steps) {
    step.until = 0;
  }
  const Session again = parse_session(session_text(session), "a.chainmail");
  QVERIFY(again.moves.empty());
  QVERIFY(again.lesson == session.lesson);
}

CHAINMAIL_TEST(LessonTest)

}  // namespace chainmail::test_lesson

#include "test_lesson.moc"
