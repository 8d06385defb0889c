#include <QTemporaryDir>
#include <QtTest>

#include "files/session/softness_csv.h"
#include "files/support.h"
#include "program.h"

namespace chainmail::test_softness {

using namespace chainmail::test;

/// Tests the softness of single links from CSV. The line of four elements has the links 0-1, 1-2 and 2-3, in this
/// order.
class SoftnessFileTest : public QObject {
  Q_OBJECT

 private slots:
  void rows_are_links();
  void what_is_skipped();
  void line_ends_and_byte_order_mark();
  void other_rows_are_refused_data();
  void other_rows_are_refused();
  void files();

 private:
  OwnSoftness read(const std::string& text) const {
    return read_softness(text, std::filesystem::path("a.csv"), *mesh_);
  }

  MeshPointer mesh_ = made(MeshKind::line, {4, 1, 1});
};

using Links = OwnSoftness;

void SoftnessFileTest::rows_are_links() {
  QVERIFY(read("3,2,0,1e3,0\n0,1,0.5,1.5,0.25") == (Links{{0, {0.5, 1.5, 0.25}}, {2, {0, 1000, 0}}}));
  QVERIFY(read("3,2,0,1e3,0,0.5,2,-3\n0,1,0.5,1.5,0.25") ==
          (Links{{0, {0.5, 1.5, 0.25}}, {2, {0, 1000, 0, 0.5, 2, -3}}}));
  QVERIFY(read(" 1 ,\t2 , 1,1 ,0 \n") == (Links{{1, {1, 1, 0}}}));
}

void SoftnessFileTest::what_is_skipped() {
  const Links one{{1, {1, 2, 3}}};
  QVERIFY(read("a,b,compression,stretch,shear\n1,2,1,2,3\n") == one);
  QVERIFY(read("a,b,compression,stretch,shear,lateral,stiffness,exponent\n1,2,1,2,3\n") == one);
  QVERIFY(read("# by hand\n\n  \na, b, compression, stretch, shear\n1,2,1,2,3 # stiff\n\n") == one);
  QVERIFY(read("# nothing\n").empty());
}

void SoftnessFileTest::line_ends_and_byte_order_mark() {
  QVERIFY(read("\xef\xbb\xbf"
               "a,b,compression,stretch,shear\r\n1,2,1,2,3\r\n0,1,1,1,1\r\n") ==
          (Links{{0, {1, 1, 1}}, {1, {1, 2, 3}}}));
  QVERIFY(read("1,2,1,2,3\r0,1,1,1,1\r") == (Links{{0, {1, 1, 1}}, {1, {1, 2, 3}}}));
}

void SoftnessFileTest::other_rows_are_refused_data() {
  QTest::addColumn<QString>("text");
  QTest::addColumn<QString>("said");
  const auto row = [](const char* text, const char* said) { QTest::newRow(text) << QString(text) << QString(said); };
  row("1,2,1,2", "a.csv:1: the row has 4 fields, not five or eight; ");
  row("\n#\n1,2,1,2,3,", "a.csv:3: the row has 6 fields, not five or eight; ");
  row("1 2 1 2 3", "a.csv:1: the row has 1 field, not five or eight; ");
  row("1,2,1,2,x", "a.csv:1: 'x' is not a finite number; ");
  row("1,2,,2,3", "a.csv:1: '' is not a finite number; ");
  row("1,2,nan,2,3", "a.csv:1: 'nan' is not a finite number; ");
  row("1,2,1,inf,3", "a.csv:1: 'inf' is not a finite number; ");
  row("1,2,1,1e999,3", "a.csv:1: '1e999' is not a finite number; ");
  row("-1,2,1,2,3", "a.csv:1: '-1' is not an element's id; ");
  row("1.0,2,1,2,3", "a.csv:1: '1.0' is not an element's id; ");
  row("1,99999999999,1,2,3", "a.csv:1: '99999999999' is not an element's id; ");
  row("1,4,1,2,3", "a.csv:1: there is no element 4; ids run from 0 to 3");
  row("1,4294967295,1,2,3", "a.csv:1: there is no element 4294967295; ");
  row("1,3,1,2,3", "a.csv:1: the elements 1 and 3 are not linked; ");
  row("2,2,1,2,3", "a.csv:1: the elements 2 and 2 are not linked; ");
  row("1,2,1,2,3\n0,1,1,1,0\n2,1,1,2,3", "a.csv:3: this link is given twice, first in line 1; ");
  row("1,2,1.1,2,3", "a.csv:1: compression: ");
  row("1,2,-0.1,2,3", "a.csv:1: compression: ");
  row("1,2,1,0.99,3", "a.csv:1: stretch: ");
  row("1,2,1,2,-1", "a.csv:1: shear: ");
  row("1,2,1,2,3,0.1,1", "a.csv:1: the row has 7 fields, not five or eight; ");
  row("1,2,1,2,3,-0.1,1,0", "a.csv:1: lateral: ");
  row("1,2,1,2,3,0,0,0", "a.csv:1: stiffness: ");
  row("1,2,1,2,3,0,1,-4.5", "a.csv:1: exponent: ");
  // A line with other names, or after the first row, is not a header.
  row("a,b,stretch,compression,shear", "a.csv:1: 'a' is not an element's id; ");
  row("A,B,compression,stretch,shear", "a.csv:1: 'A' is not an element's id; ");
  row("1,2,1,2,3\na,b,compression,stretch,shear", "a.csv:2: 'a' is not an element's id; ");
}

void SoftnessFileTest::other_rows_are_refused() {
  QFETCH(QString, text);
  QFETCH(QString, said);
  const QString error = error_of([&] { read(text.toStdString()); });
  QVERIFY2(error.startsWith(said), qPrintable(error));
}

void SoftnessFileTest::files() {
  const QTemporaryDir folder;
  const std::filesystem::path path = folder.filePath("a.csv").toStdString();
  const QString shown = QString::fromStdString(path.string());
  QVERIFY(error_of([&] { read_softness(path, *mesh_); }).startsWith(shown + ": there is no such file; "));
  put_file(path, "");
  QCOMPARE(error_of([&] { read_softness(path, *mesh_); }), shown + ": it is empty; use a file that contains softness");
  put_file(path, "1,2,1,2,3\n");
  QVERIFY(read_softness(path, *mesh_) == (Links{{1, {1, 2, 3}}}));
}

CHAINMAIL_TEST(SoftnessFileTest)

}  // namespace chainmail::test_softness

#include "test_softness.moc"
