#include <QDirIterator>
#include <QFile>
#include <QRegularExpression>
#include <QtTest>
#include <algorithm>

#include "folders.h"
#include "program.h"

namespace chainmail::test_includes {

/// One rule of direction: app → ui → core. In each of them, every source belongs to a room, and a room may include only
/// the rooms that the table lists for it. Qt and OpenGL stay in ui, and each library in the room that wraps it.
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

const QString root = sourceFile();

/// A folder of sources, and the rooms directly below it. It may include these and all that they may include. A folder
/// in a room without a row of its own belongs to that room.
struct Room {
  QString folder;
  QStringList below;
  QStringList alone = {};  // rooms that it may include, but not what these may include
};

/// The rooms of core that the programs of this project include.
const QStringList interface_of_core{"core/mesh",         "core/body",          "core/solver",        "core/simulate",
                                    "core/measure",      "core/calibrate",     "core/report/table",  "core/report/run",
                                    "core/report/page",  "core/files/text",    "core/files/formats", "core/files/mesh",
                                    "core/files/repair", "core/files/session", "core/files/results"};

const QList<Room> rooms{
    {"core/mesh", {}},
    {"core/elastic", {"core/mesh"}},
    {"core/body", {"core/elastic"}},
    {"core/chainmail", {"core/body"}},
    {"core/exact", {"core/chainmail"}},
    {"core/equilibrium", {"core/exact"}},
    {"core/solver", {"core/equilibrium"}},
    // The command line links Bullet, which is no part of the public interface, by a header that includes no room.
    {"core/bullet/register_bullet.h", {}},
    {"core/bullet", {"core/solver", "core/bullet/register_bullet.h"}},
    {"core/measure", {"core/solver"}},
    {"core/simulate", {"core/measure"}},
    {"core/report/table", {"core/simulate"}},
    {"core/report/run", {"core/report/table"}},
    {"core/report/page", {"core/report/run"}},
    {"core/calibrate", {"core/report/run"}},
    {"core/files/text", {"core/mesh"}},
    {"core/files/formats", {"core/files/text", "core/measure"}},
    {"core/files/import", {"core/files/formats"}},
    {"core/files/mesh", {"core/files/import"}},
    {"core/files/import/program", {"core/files/mesh"}},
    {"core/files/repair", {"core/files/mesh"}},
    {"core/files/session", {"core/files/mesh", "core/simulate"}},
    {"core/files/results", {"core/files/repair", "core/calibrate", "core/report/page"}},
    {"core/files/schema", {"core/files/session", "core/files/results"}},
    {"core/chainmail.h", {"core/files/mesh", "core/simulate"}},
    {"core/examples", {"core/chainmail.h", "core/files/results"}},
    {"ui/common", {"core/files/session", "core/files/results"}},
    {"ui/document", {"ui/common"}},
    {"ui/drawing", {"ui/common"}},
    {"ui/panels", {"ui/document", "ui/drawing"}},
    {"ui/tools", {"ui/panels"}},
    {"ui/io", {"ui/panels"}},
    {"ui/docks", {"ui/tools", "ui/io"}},
    {"ui/window", {"ui/docks"}},
    {"app/version", {}},
    {"app/command_line", {"app/version", "core/bullet/register_bullet.h"}, interface_of_core},
    {"app/python", {}, interface_of_core},
    {"app", {"app/command_line", "ui/window"}},
};

/// A library that one room wraps. Other rooms include that room instead.
struct Wrapped {
  QRegularExpression headers;
  QStringList folders;  // may include the library, with their subfolders
  QString rule;
};

const QList<Wrapped> libraries{
    {QRegularExpression("^(Qt?[A-Z]|qt|Q[a-z]+$|q[a-z]+\\.h$|GL/|GLES|EGL/|OpenGL|GLFW|glad|epoxy|KHR/)"),
     {"ui", "app/workbench.cpp"},
     "Qt and OpenGL belong in ui"},
    {QRegularExpression("^nlohmann/"), {"core/files"}, "JSON belongs in core/files"},
    {QRegularExpression("^(gmsh|CGAL/|teem/)"),
     {"core/files/import/program"},
     "libraries that read meshes run only in the import program"},
    {QRegularExpression("^seccomp"), {"core/files/import"}, "the sandbox belongs in core/files/import"},
    {QRegularExpression("^nlopt"), {"core/calibrate"}, "optimization belongs in core/calibrate"},
    {QRegularExpression("^(Bullet|LinearMath/|btBullet)"), {"core/bullet"}, "Bullet belongs in core/bullet"},
    {QRegularExpression("^CLI/|^CLI\\."), {"app"}, "arguments belong in app"},
    {QRegularExpression("^(pybind11/|Python)"), {"app/python"}, "Python belongs in app/python"},
    {QRegularExpression("^Eigen/"),
     {"core/mesh", "core/elastic", "core/body", "core/chainmail", "core/exact", "core/equilibrium", "core/solver",
      "core/measure", "core/simulate", "core/report", "core/files", "core/calibrate", "core/examples", "ui", "app"},
     "Eigen belongs in core and above it"},
    {QRegularExpression("^rapidcheck"), {"tests/property.h"}, "tests/property.h checks properties"},
};

bool is_within(const QString& file, const QString& folder) { return file == folder || file.startsWith(folder + "/"); }

/// Returns the innermost room of a file, or null.
const Room* room_of(const QString& file) {
  const Room* innermost = nullptr;
  for (const Room& room : rooms) {
    const bool longer = innermost == nullptr || room.folder.size() > innermost->folder.size();
    innermost = is_within(file, room.folder) && longer ? &room : innermost;
  }
  return innermost;
}

/// True if `room` is `other`, or may include it.
bool sees(const QString& room, const QString& other) {
  const auto found = std::find_if(rooms.begin(), rooms.end(), [&](const Room& one) { return one.folder == room; });
  return room == other || found->alone.contains(other) ||
         std::any_of(found->below.begin(), found->below.end(),
                     [&](const QString& below) { return sees(below, other); });
}

/// Returns the path from the root of one of our headers as an #include names it. The compiler searches core, ui
/// and app.
QString path_of(const QString& included) {
  for (const QString folder : {"core/", "ui/", "app/"}) {
    if (const Room* room = room_of(folder + included); room != nullptr && room->folder.contains('/')) {
      return folder + included;
    }
  }
  return included;
}

/// Returns the reason why a file, given by its path from the root, may not include this; empty if it may.
QString fault(const QString& file, const QString& included) {
  if (included.startsWith("..") || included.contains("/../")) {
    return "must not use a relative path";
  }
  const bool tests = file.startsWith("tests/");
  for (const Wrapped& library : libraries) {
    const bool allowed = std::any_of(library.folders.begin(), library.folders.end(),
                                     [&](const QString& folder) { return is_within(file, folder); });
    const bool checked = !tests || library.folders.first().startsWith("tests/");
    if (checked && !allowed && library.headers.match(included).hasMatch()) {
      return library.rule;
    }
  }
  const Room* room = room_of(file);
  const Room* other = room_of(path_of(included));
  if (room == nullptr) {
    return tests ? "" : "is in no room";
  }
  return other == nullptr || sees(room->folder, other->folder) ? ""
                                                               : room->folder + " must not include " + other->folder;
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

/// These files poll a condition, with a limit, and so may sleep.
const QStringList polling{"tests/core/threads.h", "tests/program.h"};

/// Returns the lines of a source, from 1, that wait for a fixed time instead of an event. On a busy machine the event
/// comes later; on an idle machine the test wastes time.
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
  row("core/body/body.h", "#include \"mesh/mesh.h\"", true);
  row("core/body/body.h", "#include \"body/region.h\"", true);
  row("core/exact/exact.h", "#include \"chainmail/propagate.h\"", true);
  row("core/report/run/compare.h", "#include \"simulate/simulation.h\"", true);
  row("core/report/page/tables.h", "#include \"report/run/compare.h\"", true);
  row("core/files/formats/obj.cpp", "#include \"files/text/text.h\"", true);
  row("core/files/text/json_scan.h", "#include <nlohmann/json.hpp>", true);
  row("core/files/mesh/open_mesh.cpp", "#include \"files/import/import_process.h\"", true);
  row("core/files/import/program/fill.cpp", "#include \"files/mesh/fill.h\"", true);
  row("core/files/import/program/fill.cpp", "#include <gmsh.h>", true);
  row("core/files/repair/repair.cpp", "#include \"files/import/import_process.h\"", true);
  row("core/files/text/json_fields.h", "#include \"body/softness.h\"", false);
  row("core/calibrate/optimum.cpp", "#include <nlopt.h>", true);
  row("core/bullet/soft_body.cpp", "#include <BulletSoftBody/btSoftBody.h>", true);
  row("core/bullet/soft_body.h", "#include \"solver/algorithms.h\"", true);
  row("app/command_line/compare_suite.cpp", "#include \"bullet/register_bullet.h\"", true);
  row("app/command_line/compare.cpp", "#include \"report/run/compare.h\"", true);
  row("app/command_line/deform.cpp", "#include \"files/text/text.h\"", true);
  row("app/chainmail.cpp", "#include \"mesh/error.h\"", true);
  row("core/calibrate/drags.h", "#include \"report/run/cases.h\"", true);
  row("core/chainmail.h", "#include \"solver/deformer.h\"", true);
  row("core/examples/drag.cpp", "#include <chainmail/chainmail.h>", true);
  row("core/examples/compare.cpp", "#include <chainmail/report/run/compare.h>", true);
  row("core/mesh/mesh.h", "#include \"chainmail.h\"", false);
  row("ui/panels/view.h", "#include <QOpenGLWidget>", true);
  row("ui/panels/view.h", "#include \"simulate/frame.h\"", true);
  row("ui/panels/view.h", "#include \"drawing/camera.h\"", true);
  row("ui/docks/report/report_dock.h", "#include \"docks/tools_dock.h\"", true);
  row("ui/window/main_window.cpp", "#include \"docks/report/report_dock.h\"", true);
  row("app/workbench.cpp", "#include <QApplication>", true);
  row("app/workbench.cpp", "#include \"window/main_window.h\"", true);
  row("app/command_line/common.h", "#include <CLI/CLI.hpp>", true);
  row("app/python/object.h", "#include \"body/body.h\"", true);
  row("app/python/reports.cpp", "#include \"files/results/results_json.h\"", true);
  row("tests/property.h", "#include <rapidcheck.h>", true);
  row("tests/core/exact/test_exact.cpp", "#include \"property.h\"", true);
  row("tests/core/exact/test_exact.cpp", "#include <rapidcheck.h>", false);
  row("core/mesh/mesh.h", "#include <QVector>", false);
  row("core/mesh/mesh.h", "  #  include <QtCore/qglobal.h>", false);
  row("core/files/formats/obj.cpp", "#include <QFile>", false);
  row("core/files/formats/obj.cpp", "#include <qfile.h>", false);
  row("core/files/mesh/open_mesh.cpp", "#include <gmsh.h>", false);
  row("core/simulate/frame.h", "#include <GL/gl.h>", false);
  row("core/simulate/frame.h", "#include <nlohmann/json.hpp>", false);
  row("ui/io/sessions.cpp", "#include <nlohmann/json.hpp>", false);
  row("core/simulate/parameters.h", "#include <CLI/CLI.hpp>", false);
  row("core/simulate/parameters.h", "#include \"files/mesh/mesh_file.h\"", false);
  row("core/report/run/compare.cpp", "#include <nlopt.hpp>", false);
  row("core/report/run/compare.cpp", "#include \"calibrate/calibrate.h\"", false);
  row("core/solver/algorithms.cpp", "#include <BulletSoftBody/btSoftBody.h>", false);
  row("core/solver/algorithms.cpp", "#include \"bullet/soft_body.h\"", false);
  row("core/bullet/soft_body.h", "#include \"report/run/compare.h\"", false);
  row("core/report/run/compare.cpp", "#include \"report/page/tables.h\"", false);
  row("core/files/formats/obj.h", "#include \"files/mesh/mesh_file.h\"", false);
  row("core/files/repair/repair.cpp", "#include <CGAL/Surface_mesh.h>", false);
  row("core/files/mesh/open_mesh.cpp", "#include \"files/session/session.h\"", false);
  row("core/mesh/mesh.h", "#include \"body/softness.h\"", false);
  row("core/body/body.h", "#include \"chainmail/waiting_list.h\"", false);
  row("core/chainmail/propagate.h", "#include \"exact/exact.h\"", false);
  row("core/exact/exact.h", "#include \"equilibrium/relaxation.h\"", false);
  row("core/equilibrium/relaxation.h", "#include \"solver/deformer.h\"", false);
  row("core/elastic/energy.h", "#include \"body/body.h\"", false);
  row("core/solver/deformer.h", "#include \"measure/violation.h\"", false);
  row("core/measure/violation.h", "#include \"simulate/simulation.h\"", false);
  row("core/simulate/simulation.h", "#include \"report/page/tables.h\"", false);
  row("core/mesh/mesh.h", "#include \"../body/softness.h\"", false);
  row("core/simulate/frame.h", "#include \"panels/view.h\"", false);
  row("core/files/formats/obj.cpp", "#include \"command_line/common.h\"", false);
  row("ui/panels/view.h", "#include \"command_line/common.h\"", false);
  row("app/command_line/common.h", "#include \"panels/view.h\"", false);
  row("app/python/object.h", "#include \"exact/exact.h\"", false);
  row("app/command_line/compare_suite.cpp", "#include \"bullet/soft_body.h\"", false);
  row("app/command_line/deform.cpp", "#include \"chainmail/mesh.h\"", false);
  row("app/command_line/deform.cpp", "#include \"exact/exact.h\"", false);
  row("app/command_line/common.cpp", "#include \"equilibrium/relaxation_scheme.h\"", false);
  row("app/command_line/convert.cpp", "#include \"files/import/import_process.h\"", false);
  row("core/bullet/register_bullet.h", "#include \"solver/algorithms.h\"", false);
  row("ui/document/document.h", "#include \"drawing/camera.h\"", false);
  row("ui/drawing/camera.h", "#include \"document/document.h\"", false);
  row("ui/panels/panel.cpp", "#include \"tools/cut_tool.h\"", false);
  row("ui/tools/cut_tool.cpp", "#include \"io/samples.h\"", false);
  row("ui/io/autosave.cpp", "#include \"window/main_window.h\"", false);
  row("ui/docks/mesh_dock.cpp", "#include \"window/docks.h\"", false);
  row("ui/view.cpp", "#include <vector>", false);
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
  for (const QString& file : core + sources_below("ui") + sources_below("app") + sources_below("tests")) {
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
  // Literals are split, so that this file does not contain such a call.
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
  row("  QTRY_VERIFY(bench.document().solvers().idle());", false);
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
  QVERIFY2(tests.contains(polling.front()), "the tests were not found");
  QStringList waits;
  for (const QString& file : tests) {
    QFile source(root + "/" + file);
    QVERIFY(source.open(QIODevice::ReadOnly));
    if (polling.contains(file)) {
      continue;
    }
    for (const int line : fixed_waits_in(QString::fromUtf8(source.readAll()))) {
      waits << QString("%1:%2").arg(file).arg(line);
    }
  }
  QVERIFY2(waits.isEmpty(), qPrintable("wait for an event (QTRY_…, a signal, wait_until):\n" + waits.join('\n')));
}

CHAINMAIL_TEST(IncludesTest)

}  // namespace chainmail::test_includes

#include "test_includes.moc"
