#include <QtTest>
#include <random>

#include "files/support.h"
#include "program.h"

namespace chainmail::test_hostile {

using namespace chainmail::test;

/// Paths that are no files, and files with false content: each gives one error sentence, without a crash and without
/// more memory than the file's own size.
class HostileTest : public QObject {
  Q_OBJECT

 private slots:
  void wrong_paths();
  void files_that_hold_nothing();
  void rubbish_data();
  void rubbish();
  void huge_claims_take_no_memory();
  void truncated_files_are_refused_or_whole();
  void changed_bytes_never_crash();
  void endings_are_known_in_any_case();
  void names_need_not_be_utf8();

 private:
  QString read(const std::string& name, const std::string& text) {
    put_file(path(name), text);
    return error_of([&] { read_mesh(path(name)); });
  }
  std::filesystem::path path(const std::string& name) const {
    return std::filesystem::path(folder_.path().toStdString()) / name;
  }

  QTemporaryDir folder_;
};

void HostileTest::wrong_paths() {
  const auto error = [&](const std::string& name) { return error_of([&] { read_mesh(path(name)); }); };
  QVERIFY(error("none.dat").endsWith("none.dat: there is no such file; check the path"));
  QVERIFY(error("none").endsWith("none: there is no such file; check the path"));
  std::filesystem::create_directory(path("folder.dat"));
  QVERIFY(error("folder.dat").endsWith("folder.dat: it is a folder; use a file"));
  const QString known =
      "; open a mesh in one of these formats: " + QString::fromStdString(mesh_endings(FormatUse::read));
  put_file(path("a.doc"), "text");
  QVERIFY(error("a.doc").endsWith("a.doc: the ending .doc is not known" + known));
  put_file(path("a"), "0 0");
  QVERIFY(error("a").endsWith("a: its name has no ending" + known));
  std::filesystem::create_symlink("loop.obj", path("loop.obj"));
  QVERIFY(error("loop.obj").contains("loop.obj: "));
  QVERIFY(error("none.dat/a.dat").contains("there is no such file"));
}

void HostileTest::files_that_hold_nothing() {
  QVERIFY(read("empty.dat", "").contains("empty.dat: it is empty; "));
  QVERIFY(read("empty.obj", "").contains("empty.obj: it is empty; "));
  QVERIFY(read("blank.dat", "\n \n\t\n").contains("blank.dat: it contains no rows; "));
  QVERIFY(read("blank.obj", "# nothing\n").contains("blank.obj: it contains no vertices; "));
}

void HostileTest::rubbish_data() {
  QTest::addColumn<QString>("name");
  QTest::newRow("dat") << "2x2.dat";
  QTest::newRow("obj") << "a.obj";
}

void HostileTest::rubbish() {
  QFETCH(QString, name);
  std::mt19937 random(7);
  std::string binary(100'000, ' ');
  for (char& c : binary) {
    c = static_cast<char>(random());
  }
  const std::string file = name.toStdString();
  QVERIFY(read(file, binary).contains(": it is not a text file; "));
  std::replace(binary.begin(), binary.end(), '\0', '1');
  const auto error = read(file, binary);
  QVERIFY(error.contains(name + ":") && !error.contains('\n'));
  QVERIFY(!read(file, "hello world\n").isEmpty());
  QVERIFY(!read(file, std::string(1'000'000, '9')).isEmpty());
}

void HostileTest::huge_claims_take_no_memory() {
  QVERIFY(read("a.dat", "# size 4000 5000\n0 4294967295 1\n").contains("a.dat:2: the count says 4294967295"));
  QVERIFY(read("a.dat", "# size 4294967295 4294967295 4294967295\n0 0\n").contains("a.dat:1: the size"));
  QVERIFY(read("a.dat", "# size 4000 5000\n0 0\n").contains("a.dat:2: the file ends without a row for element 1"));
  QVERIFY(read("a.dat", "# size 4000 5000\n19999999 0\n").contains("without a row for element 0"));
  QVERIFY(
      read("a.dat", "# size 2\n0 1 4294967295\n1 0\n").contains("a.dat:2: element 0 lists the neighbour 4294967295"));
  QVERIFY(read("a.obj", "v 0 0 0\nf 1 2 19999999\n").contains("a.obj:2: there is no vertex"));
  QVERIFY(read("a.vtk", "# vtk DataFile Version 3.0\na\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 270 270 270\n")
              .contains("it has fewer bytes than its grid has points"));
  // Subdivision tags contain the number of values that follow; they are passed over.
  QCOMPARE(read("a.obj", "v 0 0 0\nt crease 2000000000/2000000000/0 1\n"), QString());
}

void HostileTest::truncated_files_are_refused_or_whole() {
  const std::string dat = dat_text(*made(MeshKind::grid, {4, 3, 1}));
  const std::string obj = obj_text(*made(MeshKind::cloth, {3, 3, 1}));
  for (std::size_t length = 1; length + 1 < dat.size(); ++length) {
    QVERIFY(!read("a.dat", dat.substr(0, length)).isEmpty());
  }
  for (std::size_t length = 1; length < obj.size(); ++length) {
    read("a.obj", obj.substr(0, length));
  }
}

void HostileTest::changed_bytes_never_crash() {
  std::mt19937 random(11);
  const std::string lattice = "# size 3 2\n# spacing 1\n" + dat_text(*made(MeshKind::grid, {3, 2, 1}));
  const std::string surface = "f 1/1 2//2 -1\n" + obj_text(*made(MeshKind::cloth, {3, 2, 1}));
  for (int i = 0; i < 4000; ++i) {
    std::string text = i % 2 == 0 ? lattice : surface;
    for (int j = 0; j < 3; ++j) {
      text[random() % text.size()] = "0123456789 -.#/fvl\n\rx\t"[random() % 22];
    }
    const std::function<void()> read = [&] { i % 2 == 0 ? dat(text, "a.dat") : obj(text); };
    QVERIFY(!error_of(read).contains('\n'));
  }
}

void HostileTest::endings_are_known_in_any_case() {
  QCOMPARE(read("a.DAT", "# size 1\n0 0\n"), QString());
  QCOMPARE(read("a.Obj", "v 0 0 0\n"), QString());
}

void HostileTest::names_need_not_be_utf8() {
  QCOMPARE(read("\xff\xfe.obj", "v 0 0 0\n"), QString());
  const auto error = read("\xff\n.obj", "v 0 0 x\n");
  QVERIFY2(error.contains("\\xff\\x0a.obj:1: 'x' is not a valid"), qPrintable(error));
}

CHAINMAIL_TEST(HostileTest)

}  // namespace chainmail::test_hostile

#include "test_hostile.moc"
