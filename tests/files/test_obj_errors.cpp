#include <QtTest>

#include "files/support.h"
#include "program.h"

namespace chainmail::test_obj_errors {

using namespace chainmail::test;

/// Errors in an OBJ file are reported with their line, and no wrong number is read as 0.
class ObjErrorsTest : public QObject {
  Q_OBJECT

 private slots:
  void wrong_files_data();
  void wrong_files();
  void a_face_may_have_many_corners();
};

void ObjErrorsTest::wrong_files_data() {
  QTest::addColumn<QString>("lines");
  QTest::addColumn<QString>("message");
  const auto row = [](const char* name, const char* lines, const char* message) {
    QTest::newRow(name) << lines << message;
  };
  row("word for a number", "v 0 zero 0", "mesh.obj:4: 'zero' is not a valid coordinate; ");
  row("nan", "v 0 0 nan", "mesh.obj:4: 'nan' is not a valid coordinate; ");
  row("infinite", "v inf 0 0", "mesh.obj:4: 'inf' is not a valid coordinate; ");
  row("out of range", "v 1e999 0 0", "mesh.obj:4: '1e999' is not a valid coordinate; ");
  row("absurd", "v -1e200 0 0", "mesh.obj:4: '-1e200' is not a valid coordinate; ");
  row("rubbish behind", "v 1.0.0 0 0", "mesh.obj:4: '1.0.0' is not a valid coordinate; ");
  row("two coordinates", "v 0 0", "mesh.obj:4: a vertex has 2 of its 3 coordinates; ");
  row("no coordinates", "v", "mesh.obj:4: a vertex has 0 of its 3 coordinates; ");
  row("index 0", "f 0 1 2", "mesh.obj:4: '0' is not the index of a vertex; ");
  row("index no number", "f 1 2 x", "mesh.obj:4: 'x' is not the index of a vertex; ");
  row("index broken", "f 1 2 3.5", "mesh.obj:4: '3.5' is not the index of a vertex; ");
  row("texture no number", "f 1/a 2/b 3/c", "mesh.obj:4: '1/a' is not the index of a vertex; ");
  row("index too large", "f 1 2 4", "mesh.obj:4: there is no vertex 4; ");
  row("index far too large", "f 1 2 99999999999999", "mesh.obj:4: there is no vertex 99999999999999; ");
  row("index beyond numbers", "f 1 2 99999999999999999999", "mesh.obj:4: '99999999999999999999' is not the index");
  row("index too far back", "l -1 -4", "mesh.obj:4: there is no vertex -4; ");
}

void ObjErrorsTest::wrong_files() {
  QFETCH(QString, lines);
  QFETCH(QString, message);
  const auto error = error_of([&] { obj("v 0 0 0\nv 1 0 0\nv 0 1 0\n" + lines.toStdString() + "\n"); });
  QVERIFY2(error.startsWith(message), qPrintable("said: " + error));
  QVERIFY(error.contains("; ") && !error.contains('\n'));
}

void ObjErrorsTest::a_face_may_have_many_corners() {
  std::string vertices, face = "f";
  for (int i = 1; i <= 1000; ++i) {
    const std::string x = std::to_string(i), y = std::to_string(i * i);
    vertices.append("v ").append(x).append(" ").append(y).append(" 0\n");
    face.append(" ").append(x);
  }
  const auto mesh = obj(vertices + face + "\n");
  QCOMPARE(mesh->link_count(), 1000U);
  QCOMPARE(mesh->polygons.size(), std::size_t{1001});
}

CHAINMAIL_TEST(ObjErrorsTest)

}  // namespace chainmail::test_obj_errors

#include "test_obj_errors.moc"
