#include <QtTest>

#include "files/mesh/open_mesh.h"
#include "files/support.h"
#include "folders.h"
#include "program.h"

namespace chainmail::test_scripts {

using namespace chainmail::test;

/// Tests files that look like meshes but are scripts for Gmsh: none of their commands runs.
class ScriptsTest : public QObject {
  Q_OBJECT

 private slots:
  void init();
  void a_script_is_refused_data();
  void a_script_is_refused();
  void options_beside_a_mesh_are_not_read_data();
  void options_beside_a_mesh_are_not_read();
  void a_mesh_may_begin_with_a_comment_data();
  void a_mesh_may_begin_with_a_comment();

 private:
  std::filesystem::path path(const std::string& name) const {
    return std::filesystem::path(folder_->path().toStdString()) / name;
  }
  /// Gmsh commands that start a program and overwrite a file.
  std::string script() const {
    return "SystemCall \"touch " + path("trace").string() + "\";\nPrintf(\"gone\") > \"" + path("victim").string() +
           "\";\n";
  }
  void check_nothing_happened() const {
    QVERIFY(!std::filesystem::exists(path("trace")));
    QCOMPARE(file_text(path("victim")), std::string("precious"));
  }

  std::unique_ptr<QTemporaryDir> folder_;
};

void ScriptsTest::init() {
  folder_ = std::make_unique<QTemporaryDir>();
  put_file(path("victim"), "precious");
}

void ScriptsTest::a_script_is_refused_data() {
  QTest::addColumn<QString>("name");
  QTest::addColumn<QByteArray>("before");
  const QByteArray mark = "\xef\xbb\xbf",
                   mesh = QByteArray::fromStdString(file_text(source_file("tests/files/foreign/gmsh22.msh")));
  QTest::newRow("alone") << "a.msh" << QByteArray();
  QTest::newRow("in capitals") << "a.MSH" << QByteArray();
  QTest::newRow("behind a comment") << "a.msh" << QByteArray("// $MeshFormat\n");
  // Gmsh takes these for scripts with an error at the beginning.
  QTest::newRow("behind a blank line and a mesh") << "a.msh"
                                                  << "\n" + mesh;
  QTest::newRow("behind a byte order mark and a mesh") << "a.msh" << mark + mesh;
  QTest::newRow("behind a comment and a mesh") << "a.msh"
                                               << "# comment\n" + mesh;
}

void ScriptsTest::a_script_is_refused() {
  QFETCH(QString, name);
  QFETCH(QByteArray, before);
  put_file(path(name.toStdString()), before.toStdString() + script());
  const QString error = error_of([&] { open_mesh(path(name.toStdString())); });
  QVERIFY2(error.contains(name + ": it does not begin as a ") && !error.contains('\n'), qPrintable(error));
  check_nothing_happened();
}

void ScriptsTest::options_beside_a_mesh_are_not_read_data() {
  QTest::addColumn<QString>("source");
  QTest::addColumn<QString>("name");
  QTest::newRow("Gmsh") << "gmsh22.msh"
                        << "a.msh";
  QTest::newRow("Gmsh, binary") << "gmsh41_binary.msh"
                                << "a.msh";
  QTest::newRow("named otherwise") << "gmsh22.msh"
                                   << "a.obj";
}

void ScriptsTest::options_beside_a_mesh_are_not_read() {
  QFETCH(QString, source);
  QFETCH(QString, name);
  const auto mesh = path(name.toStdString());
  std::filesystem::copy(source_file("tests/files/foreign") / source.toStdString(), mesh);
  put_file(mesh.string() + ".opt", script());
  put_file(path("a.opt"), script());
  put_file(path(".gmshrc"), script());
  const auto linked = path("linked" + mesh.extension().string());
  std::filesystem::create_symlink(mesh, linked);
  put_file(linked.string() + ".opt", script());
  QCOMPARE(open_mesh(mesh).mesh->element_count(), 44U);
  QCOMPARE(open_mesh(linked).mesh->element_count(), 44U);
  check_nothing_happened();
}

void ScriptsTest::a_mesh_may_begin_with_a_comment_data() {
  QTest::addColumn<QString>("source");
  QTest::addColumn<QByteArray>("before");
  QTest::newRow("a.msh") << "gmsh22.msh" << QByteArray("$Comments\nby hand\n$EndComments\n");
}

void ScriptsTest::a_mesh_may_begin_with_a_comment() {
  QFETCH(QString, source);
  QFETCH(QByteArray, before);
  const auto mesh = path(QTest::currentDataTag());
  put_file(mesh, before.toStdString() + file_text(source_file("tests/files/foreign") / source.toStdString()));
  QCOMPARE(open_mesh(mesh).mesh->element_count(), 44U);
}

CHAINMAIL_TEST(ScriptsTest)

}  // namespace chainmail::test_scripts

#include "test_scripts.moc"
