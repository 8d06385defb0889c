#include <QDirIterator>
#include <QFile>
#include <QRegularExpression>
#include <QtTest>

/// One rule of direction: app → ui → core, and within core mesh ← elastic ← solve ← measure ← simulate ← report.
/// core knows neither Qt nor OpenGL; libraries for file formats stay in core/files, NLopt in core/calibrate, RapidCheck
/// in tests/property.h.
class IncludesTest : public QObject {
  Q_OBJECT

 private slots:
  void the_rules_can_be_broken_data();
  void the_rules_can_be_broken();
  void the_rules_hold();
  void fixed_waits_are_found_data();
  void fixed_waits_are_found();
  void no_test_waits_for_a_fixed_time();
};

namespace {

const QString root = QStringLiteral(PROJECT_SOURCE_DIR);

/// Earlier rooms know nothing of later ones.
const QStringList rooms{"mesh", "elastic", "solve", "measure", "simulate", "report"};

bool is_qt_or_opengl(const QString& included) {
  static const QRegularExpression pattern(
      "^(Qt?[A-Z]|qt|Q[a-z]+$|q[a-z]+\\.h$|GL/|GLES|EGL/|OpenGL|GLFW|glad|epoxy|KHR/)");
  return pattern.match(included).hasMatch();
}

bool is_file_format(const QString& included) {
  static const QRegularExpression pattern("^(nlohmann/|tiny_obj_loader|CLI/|CLI\\.|assimp/|gmsh|CGAL/)");
  return pattern.match(included).hasMatch();
}

bool is_optimizer(const QString& included) { return included.startsWith("nlopt"); }

/// What is wrong with a file, given by its path from the root, that includes this; empty if nothing.
QString fault(const QString& file, const QString& included) {
  const QString room = file.section('/', 1, 1), other = included.section('/', 0, 0);
  if (included.startsWith("..") || included.contains("/../")) {
    return "goes round the rooms";
  }
  if (file.startsWith("tests/")) {
    return included.startsWith("rapidcheck") && file != "tests/property.h"
               ? "properties are checked by tests/property.h, which also explores"
               : "";
  }
  if (file.startsWith("ui/")) {
    return other == "app" ? "ui must not know app" : "";
  }
  if (!file.startsWith("core/")) {
    return "";
  }
  if (other == "ui" || other == "app") {
    return "core must not know ui or app";
  }
  if (is_qt_or_opengl(included)) {
    return "core must know neither Qt nor OpenGL";
  }
  if (room == "files") {
    return "";
  }
  if (is_optimizer(included) || other == "calibrate") {
    return room == "calibrate" ? "" : "optimization belongs in core/calibrate";
  }
  if (is_file_format(included) || other == "files") {
    return "file formats belong in core/files";
  }
  return rooms.contains(room) && rooms.indexOf(other) > rooms.indexOf(room) ? "a room must not know a later one" : "";
}

QStringList includes_of(const QString& text) {
  static const QRegularExpression pattern(R"(^[ \t]*#[ \t]*include[ \t]*[<"]([^>"]+)[>"])",
                                          QRegularExpression::MultilineOption);
  QStringList found;
  for (auto match = pattern.globalMatch(text); match.hasNext();) {
    found << match.next().captured(1);
  }
  return found;
}

/// Polls a condition, with a limit: no wait of a fixed length.
const QString polls = "tests/core/threads.h";

/// The lines of a source, from 1, that wait for a length of time and not for an event. On a busy machine the event
/// comes later than that; on an idle one the test wastes time.
QList<int> fixed_waits_in(const QString& text) {
  static const QRegularExpression pattern(
      R"((?<!->)(?<!\.)\b(qWait|qSleep|sleep_for|sleep_until|nanosleep|[mu]?sleep)\s*\()");
  const QStringList lines = text.split('\n');
  QList<int> found;
  for (int i = 0; i < lines.size(); ++i) {
    if (pattern.match(lines[i].section("//", 0, 0)).hasMatch()) {
      found << i + 1;
    }
  }
  return found;
}

QStringList sources_below(const QString& folder) {
  QStringList files;
  for (QDirIterator walk(root + "/" + folder, {"*.h", "*.cpp"}, QDir::Files, QDirIterator::Subdirectories);
       walk.hasNext();) {
    files << QDir(root).relativeFilePath(walk.next());
  }
  files.sort();
  return files;
}

}  // namespace

void IncludesTest::the_rules_can_be_broken_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<QString>("line");
  QTest::addColumn<bool>("allowed");
  const auto row = [](const char* file, const char* line, bool allowed) {
    QTest::addRow("%s: %s", file, line) << QString(file) << QString(line) << allowed;
  };
  row("core/mesh/mesh.h", "#include <vector>", true);
  row("core/mesh/mesh.h", "#include <Eigen/Core>", true);
  row("core/solve/body.h", "#include \"mesh/mesh.h\"", true);
  row("core/solve/body.h", "#include \"solve/region.h\"", true);
  row("core/report/table.h", "#include \"simulate/simulation.h\"", true);
  row("core/files/obj.cpp", "#include <tiny_obj_loader.h>", true);
  row("core/files/obj.cpp", "#include \"mesh/mesh.h\"", true);
  row("core/calibrate/optimum.cpp", "#include <nlopt.h>", true);
  row("core/calibrate/drags.h", "#include \"report/cases.h\"", true);
  row("ui/view.h", "#include <QOpenGLWidget>", true);
  row("ui/view.h", "#include \"simulate/frame.h\"", true);
  row("tests/property.h", "#include <rapidcheck.h>", true);
  row("tests/core/test_exact.cpp", "#include \"property.h\"", true);
  row("tests/core/test_exact.cpp", "#include <rapidcheck.h>", false);
  row("core/mesh/mesh.h", "#include <QVector>", false);
  row("core/mesh/mesh.h", "  #  include <QtCore/qglobal.h>", false);
  row("core/files/obj.cpp", "#include <QFile>", false);
  row("core/files/obj.cpp", "#include <qfile.h>", false);
  row("core/simulate/frame.h", "#include <GL/gl.h>", false);
  row("core/simulate/frame.h", "#include <nlohmann/json.hpp>", false);
  row("core/mesh/mesh.cpp", "#include <tiny_obj_loader.h>", false);
  row("core/simulate/parameters.h", "#include <CLI/CLI.hpp>", false);
  row("core/simulate/parameters.h", "#include \"files/mesh_file.h\"", false);
  row("core/report/compare.cpp", "#include <nlopt.hpp>", false);
  row("core/report/compare.cpp", "#include \"calibrate/calibrate.h\"", false);
  row("core/mesh/mesh.h", "#include \"solve/softness.h\"", false);
  row("core/solve/solver.h", "#include \"measure/violation.h\"", false);
  row("core/measure/violation.h", "#include \"simulate/simulation.h\"", false);
  row("core/simulate/simulation.h", "#include \"report/table.h\"", false);
  row("core/mesh/mesh.h", "#include \"../solve/softness.h\"", false);
  row("core/simulate/frame.h", "#include \"ui/view.h\"", false);
  row("core/files/obj.cpp", "#include \"app/arguments.h\"", false);
  row("ui/view.h", "#include \"app/arguments.h\"", false);
}

void IncludesTest::the_rules_can_be_broken() {
  QFETCH(QString, file);
  QFETCH(QString, line);
  QFETCH(bool, allowed);
  const QStringList included = includes_of("#pragma once\n" + line + "\nint x;\n");
  QCOMPARE(included.size(), 1);
  QCOMPARE(fault(file, included.first()).isEmpty(), allowed);
}

void IncludesTest::the_rules_hold() {
  const QStringList core = sources_below("core");
  QVERIFY2(core.size() > 20, "the sources were not found");
  QStringList faults;
  for (const QString& file : core + sources_below("ui") + sources_below("tests")) {
    QFile source(root + "/" + file);
    QVERIFY(source.open(QIODevice::ReadOnly));
    for (const QString& included : includes_of(QString::fromUtf8(source.readAll()))) {
      if (const QString wrong = fault(file, included); !wrong.isEmpty()) {
        faults << file + " includes " + included + ": " + wrong;
      }
    }
  }
  QVERIFY2(faults.isEmpty(), qPrintable("\n" + faults.join('\n')));
}

void IncludesTest::fixed_waits_are_found_data() {
  QTest::addColumn<QString>("line");
  QTest::addColumn<bool>("fixed");
  const auto row = [](const char* line, bool fixed) { QTest::newRow(line) << QString(line) << fixed; };
  // Adjacent literals, so that this file has no such call itself.
  row("  QTest::qWait"
      "(30);",
      true);
  row("  QTest::qSleep"
      "(30);",
      true);
  row("  QThread::msleep"
      "(30);",
      true);
  row("  QThread::sleep"
      "(1);",
      true);
  row("  ::usleep"
      "(30);",
      true);
  row("  std::this_thread::sleep_for"
      "(1ms);",
      true);
  row("  QTRY_VERIFY(bench.document().idle());", false);
  row("  QVERIFY(QTest::qWaitFor([&] { return done; }));", false);
  row("  QVERIFY(QTest::qWaitForWindowExposed(&window));", false);
  row("  QVERIFY(saved.wait(30'000));", false);
  row("  // not qWait"
      "(30), which fails on a busy machine",
      false);
  row("  void it_sleeps_when_nothing_is_to_do();", false);
  row("  solver->sleep();", false);
}

void IncludesTest::fixed_waits_are_found() {
  QFETCH(QString, line);
  QFETCH(bool, fixed);
  QCOMPARE(fixed_waits_in("int x;\n" + line + "\n"), fixed ? QList<int>{2} : QList<int>());
}

void IncludesTest::no_test_waits_for_a_fixed_time() {
  const QStringList tests = sources_below("tests");
  QVERIFY2(tests.contains(polls), "the tests were not found");
  QStringList waits;
  for (const QString& file : tests) {
    QFile source(root + "/" + file);
    QVERIFY(source.open(QIODevice::ReadOnly));
    for (const int line : fixed_waits_in(QString::fromUtf8(source.readAll()))) {
      waits << QString("%1:%2").arg(file).arg(line);
    }
  }
  waits.erase(std::remove_if(waits.begin(), waits.end(), [](const QString& at) { return at.startsWith(polls); }),
              waits.end());
  QVERIFY2(waits.isEmpty(), qPrintable("wait for an event (QTRY_…, a signal, wait_until):\n" + waits.join('\n')));
}

QTEST_APPLESS_MAIN(IncludesTest)
#include "test_includes.moc"
