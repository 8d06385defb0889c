#include <QtTest>
#include <filesystem>

#include "files/session_support.h"
#include "files/text/limits.h"
#include "folders.h"
#include "program.h"

namespace chainmail::test_session_errors {

using namespace chainmail::test;

/// Files that are not sessions, and sessions with wrong content: each gives an error sentence with the position, and
/// nothing is read in part.
class SessionErrorsTest : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase();
  void other_files_are_refused_data();
  void other_files_are_refused();
  void wrong_members_are_refused_data();
  void wrong_members_are_refused();
  void a_lattice_without_spacing_is_refused();
  void long_names_are_refused();
  void a_newer_version_is_named_before_all_else();
  void wrong_paths();
  void huge_claims_take_no_memory();
  void deep_nesting_is_refused();
  void what_ends_too_early_is_refused();
  void changed_bytes_never_do_worse();

 private:
  static QString read(const std::string& text) {
    return error_of([&] { parse_session(text, "a.chainmail"); });
  }
  /// Returns the error for a small session with one passage replaced; the passage must exist.
  QString with(const std::string& passage, const std::string& other) const {
    std::string text = good_;
    const auto at = text.find(passage);
    return at == std::string::npos ? QStringLiteral("no such passage") : read(text.replace(at, passage.size(), other));
  }

  std::string good_;
};

void SessionErrorsTest::initTestCase() {
  good_ = file_text(source_file("tests/files/sessions/version1.chainmail"));
  QCOMPARE(read(good_), QString());
}

void SessionErrorsTest::other_files_are_refused_data() {
  QTest::addColumn<QString>("text");
  QTest::addColumn<QString>("said");
  const auto row = [](const char* text, const char* said) { QTest::newRow(text) << QString(text) << QString(said); };
  row("{\"format\":\n}", "a.chainmail:2: it is not JSON; ");
  row("v 0 0 0", "a.chainmail:1: it is not JSON; ");
  row(" ", "a.chainmail:1: it ends too early; ");
  row("{\"format\": \"chainmail session\",\n", "a.chainmail:2: it ends too early; ");
  row("{} x", "a.chainmail:1: it is not JSON; ");
  row("{\"format\": NaN}", "a.chainmail:1: it is not JSON; ");
  row("{\"format\": 1e999}", "a.chainmail: it contains a number that is too large ");
  row("{\"rest\": [1e999]}", "a.chainmail: it contains a number that is too large ");
  row("[]", "a.chainmail: it is not a session; ");
  row("[[1], [2]]", "a.chainmail: it is not a session; ");
  row("null", "a.chainmail: it is not a session; ");
  row("{}", "a.chainmail: it is not a session; ");
  row(R"({"version": 1, "commands": []})", "a.chainmail: it is not a session; ");
  row(R"({"format": ["chainmail session"]})", "a.chainmail: it is not a session; ");
  row(R"({"format": "chainmail session"})", "a.chainmail: 'version' is missing; ");
  row(R"({"format": "chainmail session", "version": 1})", "a.chainmail: 'name' is missing; ");
}

void SessionErrorsTest::other_files_are_refused() {
  QFETCH(QString, text);
  QFETCH(QString, said);
  const QString error = read(text.toStdString());
  QVERIFY2(error.startsWith(said) && !error.contains('\n'), qPrintable(error));
}

void SessionErrorsTest::wrong_members_are_refused_data() {
  QTest::addColumn<QString>("passage");
  QTest::addColumn<QString>("other");
  QTest::addColumn<QString>("said");
  const auto row = [](const char* passage, const char* other, const char* said) {
    QTest::addRow("%s: %s", passage, other) << QString(passage) << QString(other) << QString(said);
  };
  row("\"version\": 1", "\"version\": 3",
      "its version is 3, but this program knows only version 2 and older; open it with a newer ");
  row("\"version\": 1", "\"version\": 0", "'version' is not a whole number from 1 to 2; ");
  row("\"version\": 1", "\"version\": \"1\"", "'version' is not a whole number from 1 to 2; ");
  row("\"name\": ", "\"nam\": ", "'nam' is not a known key; ");
  row("\"name\": ", "\"format\": 1, \"name\": ", "'format' appears twice; ");
  row("\"cloth 3 × 3\"", "3", "'name' is not a text; ");
  row("\"name\": ", "\"moves\": 3, \"name\": ", "moves: it contains no recorded moves; ");
  row("\"name\": ", R"("moves": {"version": 1, "commands": [{"do": "grab", "element": 9}]}, "name": )",
      "moves: command 0: ");
  row("\"name\": ", R"("moves": {"version": 1, "commands": [{"do": "cut", "links": [[0, 5]]}]}, "name": )",
      "moves: command 0: ");
  row("\"name\": ", R"("moves": {"version": 1, "commands": []}, "name": )", "'moves_done' is missing; ");
  row("\"name\": ", R"("moves": {"version": 1, "commands": []}, "moves_done": 1, "name": )",
      "'moves_done' is not a whole number from 0 to 0; ");
  row("\"elements\": 9", "\"elements\": 8", "mesh: 'rest' contains 27 numbers, but 8 elements have 24; ");
  row("\"elements\": 9", "\"elements\": 0", "mesh: 'elements' is not a whole number from 1 to 20000000; ");
  row("\"elements\": 9", "\"elements\": -9", "mesh: 'elements' is not a whole number from 1 to 20000000; ");
  row("\"space\": 2", "\"space\": 1", "mesh: space dimension 1: the object extends along 2 axes; ");
  row("\"space\": 2", "\"space\": 4", "mesh: 'space' is not a whole number from 1 to 3; ");
  row("\"size\": [3,3,1]", "\"size\": [3,2,1]", "mesh: the size of the lattice does not give 9 elements; ");
  row("\"size\": [3,3,1]", "\"size\": [3,3]", "mesh: the size of the lattice does not give 9 elements; ");
  row("\"size\": [3,3,1]", "\"size\": [3,3,1.0]", "mesh: the size of the lattice does not give 9 elements; ");
  row("\"spacing\": 1.5", "\"spacing\": 1", "mesh: element 1 is not at its position in the lattice; ");
  row("\"spacing\": 1.5", "\"spacing\": null", "mesh: 'null' is not a number; ");
  row("\"spacing\": 1.5", "\"spacing\": -1.5", "mesh: spacing: ");
  row("3,3,0],", "3,3,1e101],", "mesh: 'rest' puts element 8 beyond 1e100; ");
  row("3,3,0],", "3,3,\"0\"],", "mesh: number 26 of 'rest' is not a number; ");
  row("3,3,0],", "3,3,[0]],", "mesh: number 26 of 'rest' is not a number; ");
  row("3,3,0],", "3,3,{}],", "mesh: number 26 of 'rest' is not a number; ");
  row("3,3,0],", "3,3],", "mesh: 'rest' contains 26 numbers, but 9 elements have 27; ");
  row("0,1,0,3,0,4", "0,1,0,3,0,9", "mesh: 'links' names element 9, which does not exist; ids run from 0 to 8");
  row("0,1,0,3,0,4", "0,1,0,3,0", "mesh: 'links' ends within a group of 2; ");
  row("0,1,0,3,0,4", "0,1,0,3,1,0", "mesh: 'links' contains a link twice; ");
  row("0,1,0,3,0,4", "0,1,0,3,0,0", "mesh: element 0 is linked to itself; ");
  row("0,1,0,3,0,4", "0,1,0,3,0,-4", "mesh: number 5 of 'links' is not a whole number; ");
  row("0,1,0,3,0,4", "0,1,0,3,0,4.0", "mesh: number 5 of 'links' is not a whole number; ");
  row("0,1,0,3,0,4", "0,1,0,3,0,4294967300", "mesh: number 5 of 'links' is not a whole number; ");
  row("\"triangles\": [0,1,4,", "\"triangles\": [0,1,", "mesh: 'triangles' ends within a group of 3; ");
  row("\"triangles\": [0,1,4,", "\"triangles\": [0,1,40,", "mesh: 'triangles' names element 40, which ");
  row("\"triangles\": ", "\"triangle\": ", "mesh: 'triangle' is not a known key; ");
  row("\"polygons\": []", "\"polygons\": {}", "mesh: 'polygons' is not an array; ");
  row("\"polygons\": []", "\"polygons\": 0", "mesh: 'polygons' is not an array; ");
  row("\"polygons\": []", "\"polygons\": [4,0,1,2]", "mesh: 'polygons' has a count of 4 at number 0; ");
  row("\"polygons\": []", "\"polygons\": [3,0,1,2,4294967295]",
      "mesh: 'polygons' has a count of 4294967295 at number 4; ");
  row("\"polygons\": []", "\"polygons\": [2,0,1]", "mesh: 'polygons' has a count of 2 at number 0; ");
  row("\"polygons\": []", "\"polygons\": [3,0,1,9]", "mesh: 'polygons' names element 9, which ");
  row("\"tetrahedra\": []", "\"tetrahedra\": [1]", "mesh: 'tetrahedra' ends within a group of 4; ");
  const auto texture = [&](const char* members, const char* said) {
    const QString of = QStringLiteral("\"tetrahedra\": [], \"texture\": {%1}").arg(QLatin1String(members));
    row("\"tetrahedra\": []", qPrintable(of), said);
  };
  texture("", "mesh: 'size' is missing; ");
  texture(R"("size": [1,1,1], "channels": 3, "box": [0,0,0,1,1,0], "texels": "AAAA")",
          "mesh: the texture has no size ");
  texture(R"("size": [1,1], "channels": 1, "box": [0,0,0,1,1,0], "texels": "AA==")", "mesh: the texture has no size ");
  texture(R"("size": [4294967295,4294967295,4294967295], "channels": 4, "box": [0,0,0,1,1,0], "texels": "AA==")",
          "mesh: 'texels' does not contain one byte ");
  texture(R"("size": [1,1,1], "channels": 1, "box": [0,0,0,1,0,0], "texels": "AA==")",
          "mesh: 'box' is not the box of a ");
  texture(R"("size": [1,1,1], "channels": 1, "box": [0,0,0,1,1], "texels": "AA==")",
          "mesh: 'box' contains 5 numbers; ");
  texture(R"("size": [1,1,1], "channels": 1, "box": [0,0,0,1,1,0], "texels": "AAAA")",
          "mesh: 'texels' does not contain ");
  texture(R"("size": [1,1,1], "channels": 1, "box": [0,0,0,1,1,0], "texels": "A!==")",
          "mesh: 'texels' does not contain ");
  texture(R"("size": [1,1,1], "channels": 1, "box": [0,0,0,1,1,0], "texels": [0])", "mesh: 'texels' does not contain ");
  texture(R"("size": [1,1,1], "colour": 1)", "mesh: 'colour' is not a known key; ");
  row("\"cuts\": [0,1,", "\"cuts\": [0,2,", "the elements 0 and 2 are not linked; ");
  row("\"cuts\": [0,1,", "\"cuts\": [5,4,", "'cuts' contains a link twice; ");
  row("\"pins\": [0,8]", "\"pins\": [0,9]", "'pins' names element 9, which does not exist; ");
  row("\"pins\": [0,8]", "\"pins\": [8,0,8]", "'pins' contains an element twice; ");
  row("\"pins\": [0,8]", "\"pins\": true", "'pins' is not an array; ");
  row("\"stretch\":1.25", "\"stretch\":0.5", "softness: stretch: Stretch 0.5 is out of range; ");
  row("\"own\": [3,4,1,1,0]", "\"own\": [3,4,2,1,0]", "softness: compression: Compression 2 is out of range; ");
  row("\"own\": [3,4,1,1,0]", "\"own\": [3,4,1,1]", "softness: 'own' ends within a group of 5; ");
  row("\"own\": [3,4,1,1,0]", "\"own\": [3,4.5,1,1,0]",
      "softness: 'own' names an element that does not exist in its link 0; ");
  row("\"own\": [3,4,1,1,0]", "\"own\": [3,9,1,1,0]",
      "softness: 'own' names an element that does not exist in its link 0; ");
  row("\"own\": [3,4,1,1,0]", "\"own\": [3,8,1,1,0]", "softness: the elements 3 and 8 are not linked; ");
  row("\"own\": [3,4,1,1,0]", "\"own\": [3,4,1,1,0,4,3,1,1,0]", "softness: the link 4-3 is given twice; ");
  row("\"on\":false", "\"on\":0", "relaxation: 'on' is neither true nor false; ");
  row("\"scheme\":\"link\"", "\"scheme\":\"links\"", "relaxation: 'scheme' is not known; ");
  row("\"step\":0.5", "\"step\":0", "relaxation: relax-step: Step 0 is out of range; use a number above 0, up to 1");
  const auto elastic = [&row](const char* said, const char* members) {
    row("\"step\":0.5}", (std::string("\"step\":0.5}, \"elastic\": {") + members + "}").c_str(), said);
  };
  elastic("elastic: 'lattice' is missing; ", R"("young":1,"poisson":0.3)");
  elastic("elastic: 'lattice' is not an array of 3 numbers; ", R"("young":1,"poisson":0.3,"lattice":[4,4])");
  elastic("elastic: lattice: ", R"("young":1,"poisson":0.3,"lattice":[4,4,9])");
  elastic("elastic: 'lattice' is not a whole number; ", R"("young":1,"poisson":0.3,"lattice":[4,4,-4])");
  elastic("elastic: poisson: ", R"("young":1,"poisson":0.5,"lattice":[4,4,4])");
  elastic("elastic: young: ", R"("young":0,"poisson":0.3,"lattice":[4,4,4])");
  elastic("elastic: 'law' is not known; ", R"("young":1,"poisson":0.3,"lattice":[4,4,4],"law":"hooke")");
  elastic("elastic: gent-limit: ", R"("young":1,"poisson":0.3,"lattice":[4,4,4],"law":"gent","gent_limit":0)");
  elastic("elastic: gent-limit: ", R"("young":1,"poisson":0.1,"lattice":[4,4,4],"law":"gent")");
  elastic("elastic: thickness: Thickness 0 is out of range; use 0.0001 to 1",
          R"("young":1,"poisson":0.3,"lattice":[4,4,4],"thickness":0)");
  row("\"algorithm\": \"exact\"", "\"algorithm\": \"original\"", "panel 0: 3D ChainMail: ");
  row("\"algorithm\": \"exact\"", "\"algorithm\": \"best\"", "panel 0: the algorithm \"best\" is not known; ");
  row("\"precision\": \"float\", \"from_rest\": false", "\"precision\": \"half\", \"from_rest\": false",
      "panel 1: 'precision' is not known; ");
  row("\"from_rest\": true", "\"from_rest\": 1", "panel 0: 'from_rest' is neither true nor false; ");
  row("\"runs\": [2,4]", "\"runs\": [2]", "panel 0: positions: the runs of elements are not ascending pairs; ");
  row("\"runs\": [2,4]", "\"runs\": [4,2]", "panel 0: positions: the runs of elements are not ascending pairs; ");
  row("\"runs\": [2,4]", "\"runs\": [2,4,3,4]", "panel 0: positions: the runs of elements are not ascending pairs; ");
  row("\"runs\": [2,4]", "\"runs\": [2,4294967295]",
      "panel 0: positions: the runs of elements are not ascending pairs; ");
  row("\"runs\": [2,4]", "\"runs\": [2,5]",
      "panel 0: positions: there are 4 coordinates, but the runs contain 3 elements in 2D; ");
  row("2.5,2.25", "2.5,2.25,1", "panel 1: positions: there are 3 coordinates, but the runs contain 1 elements in 2D; ");
  row("2.5,2.25", "2.5,1e38", "panel 1: positions: a coordinate is out of the range ");
  row("\"panels\": [", "\"panels\": [7,", "panel 0: it is not an object; ");
  row("\"ui\": {\"colour\":\"plain\"}", "\"ui\": []", "'ui' is not an object; ");
}

void SessionErrorsTest::wrong_members_are_refused() {
  QFETCH(QString, passage);
  QFETCH(QString, other);
  QFETCH(QString, said);
  const QString error = with(passage.toStdString(), other.toStdString());
  QVERIFY2(error.startsWith("a.chainmail: " + said) && !error.contains('\n'), qPrintable(error));
}

/// A newer version is reported before all other errors, because its members may have another meaning.
/// All elements are at the positions that a lattice with this spacing gives.
void SessionErrorsTest::a_lattice_without_spacing_is_refused() {
  QString text = QString::fromStdString(good_);
  text.replace(QRegularExpression("\"rest\": \\[[^]]*"), "\"rest\": [0" + QString(",0").repeated(26));
  text.replace("\"spacing\": 1.5", "\"spacing\": 0");
  const QString error = read(text.toStdString());
  QVERIFY2(error.startsWith("a.chainmail: mesh: spacing: "), qPrintable(error));
}

/// Names are in titles, menus and lists.
void SessionErrorsTest::long_names_are_refused() {
  const auto name = [&](qsizetype length) {
    return with("cloth 3 × 3", QString(length, QLatin1Char('x')).toStdString());
  };
  QCOMPARE(name(limits::name_bytes), QString());
  QCOMPARE(name(limits::name_bytes + 1), QString("a.chainmail: 'name' has 256 bytes; use at most 255"));
  QString text = QString::fromStdString(good_);
  text.replace(
      QRegularExpression("\"mesh\": \\{.*\\},(?=\\s*\"cuts\")", QRegularExpression::DotMatchesEverythingOption),
      "\"mesh\": {\"file\": \"" + QString(5000, QLatin1Char('x')) + "\"},");
  QCOMPARE(read(text.toStdString()), QString("a.chainmail: mesh: 'file' has 5000 bytes; use at most 255"));
}

void SessionErrorsTest::a_newer_version_is_named_before_all_else() {
  const auto error = read(R"({"format": "chainmail session", "version": 7, "mesh": [], "rest": "elsewhere"})");
  QCOMPARE(error, QString("a.chainmail: its version is 7, but this program knows only version 2 and older; "
                          "open it with a newer program"));
}

void SessionErrorsTest::wrong_paths() {
  const QTemporaryDir folder;
  const std::filesystem::path path = folder.filePath("a.chainmail").toStdString();
  const auto error = [&] { return error_of([&] { read_session(path); }); };
  QVERIFY(error().endsWith("a.chainmail: there is no such file; check the path"));
  put_file(path, "");
  QVERIFY(error().endsWith("a.chainmail: it is empty; use a file that contains a session"));
  put_file(path, std::string("{\0}", 3));
  QVERIFY(error().endsWith("a.chainmail: it is not a text file; use a text file with a session"));
  put_file(path, "\xef\xbb\xbf" + good_);
  QCOMPARE(error(), QString());
}

void SessionErrorsTest::huge_claims_take_no_memory() {
  QVERIFY(
      with("\"elements\": 9", "\"elements\": 1000000000").contains("mesh: 'elements' is not a whole number from 1 "));
  QVERIFY(
      with("\"elements\": 9", "\"elements\": 20000000").contains("mesh: 'rest' contains 27 numbers, but 20000000 "));
  QVERIFY(with("\"elements\": 9", "\"elements\": 18446744073709551617").contains("mesh: 'elements' is not a whole "));
  QVERIFY(with("[3,3,1]", "[4294967295,4294967295,4294967295]").contains("mesh: the size of the lattice does not "));
  const auto table = [&](const char* counts) {
    std::string text = good_;
    const auto first = text.find("\"links\""), end = text.find("\"triangles\"");
    return read(text.replace(first, end - first, "\"counts\": " + std::string(counts) + ", \"neighbours\": [1,0],"));
  };
  QVERIFY(table("[4294967295,3,0,0,0,0,0,0,0]").contains("mesh: 'counts' and 'neighbours' do not match; "));
  QVERIFY(table("[1,1]").contains("mesh: 'counts' and 'neighbours' do not match; "));
  QVERIFY(table("[2,0,0,0,0,0,0,0,0]").contains("mesh: element 0 is linked to itself; "));
  QVERIFY(table("[0,2,0,0,0,0,0,0,0]").contains("mesh: element 1 is linked to itself; "));
  QVERIFY(table("[1,0,1,0,0,0,0,0,0]").contains("mesh: element 0 lists 1, but 1 does not list 0; "));
}

void SessionErrorsTest::deep_nesting_is_refused() {
  for (const char* open : {"[", "{\"a\":"}) {
    std::string text;
    for (int i = 0; i < 200'000; ++i) {
      text += open;
    }
    QVERIFY(read(text).startsWith("a.chainmail: it is nested too deeply; "));
  }
}

void SessionErrorsTest::what_ends_too_early_is_refused() {
  // Except for the end of the last line.
  for (std::size_t i = 0; i + 1 < good_.size(); ++i) {
    const QString error = read(good_.substr(0, i));
    QVERIFY2(!error.isEmpty() && !error.contains('\n'), qPrintable(QString::number(i)));
  }
}

void SessionErrorsTest::changed_bytes_never_do_worse() {
  std::mt19937 random(3);
  const std::string others = "0123456789-.,:[]{}\"e \nt\xff";
  for (int i = 0; i < 20'000; ++i) {
    std::string text = good_;
    for (int j = i % 3; j >= 0; --j) {
      text[random() % text.size()] = others[random() % others.size()];
    }
    QVERIFY(!read(text).contains('\n'));
  }
}

CHAINMAIL_TEST(SessionErrorsTest)

}  // namespace chainmail::test_session_errors

#include "test_session_errors.moc"
