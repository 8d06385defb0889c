#include <QtTest>

#include "files/support.h"
#include "program.h"

namespace chainmail::test_dat_errors {

using namespace chainmail::test;

/// Errors in a .dat file are reported with their line.
class DatErrorsTest : public QObject {
  Q_OBJECT

 private slots:
  void wrong_files_data();
  void wrong_files();
  void prose_is_no_statement();
  void options_that_do_not_fit();
};

void DatErrorsTest::wrong_files_data() {
  QTest::addColumn<QString>("text");
  QTest::addColumn<QString>("message");
  const auto row = [](const char* name, const char* text, const char* message) {
    QTest::newRow(name) << text << message;
  };
  row("one side only", "# size 3\n0 1 1\n1 1 2\n2 1 1\n", "mesh.dat:2: element 0 lists 1, but 1 does not list 0; ");
  row("neighbour out of range", "# size 2\n0 1 1\n1 2 0 2\n",
      "mesh.dat:3: element 1 lists the neighbour 2, which is out of range; ");
  row("to itself", "# size 2\n0 1 0\n1 0\n", "mesh.dat:2: element 0 is linked to itself; ");
  row("double", "# size 2\n0 2 1 1\n1 2 0 0\n", "mesh.dat:2: element 0 lists the neighbour 1 twice; ");
  row("count too large", "# size 2\n0 2 1\n1 1 0\n", "mesh.dat:2: the count says 2 neighbours, but the row lists 1; ");
  row("count too small", "# size 2\n0 0 1\n1 1 0\n", "mesh.dat:2: the count says 0 neighbours, but the row lists 1; ");
  row("count huge", "# size 1\n0 4000000000 0\n", "mesh.dat:2: ");
  row("missing row", "# size 3\n0 0\n2 0\n", "mesh.dat:3: the file ends without a row for element 1 ");
  row("missing last row", "# size 3\n0 0\n1 0\n\n", "mesh.dat:4: the file ends without a row for element 2 ");
  row("double row", "# size 2\n0 0\n1 0\n0 0\n", "mesh.dat:4: element 0 already has a row in line 2; ");
  row("row beyond the size", "# size 2\n0 0\n1 0\n2 0\n", "mesh.dat:4: element 2 lies outside the size 2x1; ");
  row("id no number", "# size 1\nx 0\n", "mesh.dat:2: 'x' is not an element's id; ");
  row("id negative", "# size 1\n-1 0\n", "mesh.dat:2: '-1' is not an element's id; ");
  row("id huge", "# size 1\n99999999999 0\n", "mesh.dat:2: '99999999999' is not an element's id; ");
  row("id broken", "# size 1\n0.5 0\n", "mesh.dat:2: '0.5' is not an element's id; ");
  row("neighbour no number", "# size 2\n0 1 1,\n1 1 0\n", "mesh.dat:2: '1,' is not an element's id; ");
  row("count no number", "# size 1\n0 none\n", "mesh.dat:2: 'none' is not a count of neighbours; ");
  row("no count", "# size 1\n0\n", "mesh.dat:2: the row ends before the count; ");
  row("no rows", "# size 1\n\n", "mesh.dat: it contains no rows; ");
  row("no size", "0 0\n", "mesh.dat: the size of its lattice is not known; ");
  row("size no number", "# size 2 x\n0 0\n", "mesh.dat:1: the size must be one to three whole numbers above 0; ");
  row("size of 0", "# size 0\n0 0\n", "mesh.dat:1: the size must be one to three whole numbers above 0; ");
  row("size too long", "# size 1 1 1 1\n0 0\n", "mesh.dat:1: the size must be one to three whole numbers above 0; ");
  row("size joined", "# size 1x1\n0 0\n", "mesh.dat:1: the size must be one to three whole numbers above 0; ");
  row("size too large", "# size 99999 99999\n0 0\n",
      "mesh.dat:1: the size 99999x99999 is more than 20000000 elements; ");
  row("sizes differ", "# size 1 2\n# size 2\n0 0\n1 0\n", "mesh.dat:2: the size differs from that of line 1; ");
  row("spacing no number", "# size 1\n# spacing 1m\n0 0\n", "mesh.dat:2: the spacing is not one number above 0; ");
  row("spacing negative", "# size 1\n# spacing -1\n0 0\n", "mesh.dat:2: the spacing is not one number above 0; ");
  row("spacing 0", "# size 1\n# spacing 0\n0 0\n", "mesh.dat:2: the spacing is not one number above 0; ");
  row("spacing twice", "# size 1\n# spacing 1 2\n0 0\n", "mesh.dat:2: the spacing is not one number above 0; ");
  row("spacings differ", "# size 1\n# spacing 1\n# spacing 2\n0 0\n",
      "mesh.dat:3: the spacing differs from that of line 2; ");
  row("spacing too large", "# size 2\n# spacing 1e300\n0 0\n1 0\n", "mesh.dat:2: the spacing is too large; ");
  row("space 4", "# size 1\n# space 4\n0 0\n", "mesh.dat:2: the space dimension is not 1, 2 or 3; ");
  row("space too small", "# size 2 2\n# space 1\n0 0\n1 0\n2 0\n3 0\n", "mesh.dat:2: the mesh extends along 2 axes; ");
}

void DatErrorsTest::wrong_files() {
  QFETCH(QString, text);
  QFETCH(QString, message);
  const auto error = error_of([&] { dat(text.toStdString()); });
  QVERIFY2(error.startsWith(message), qPrintable("said: " + error));
  QVERIFY(error.contains("; ") && !error.contains('\n'));
}

void DatErrorsTest::prose_is_no_statement() {
  QCOMPARE(dat("# size 1\n# size is one\n# spacing: none\n# space\n0 0\n")->element_count(), 1U);
  QCOMPARE(dat("# size 1\n# size 1 1\n0 0\n")->element_count(), 1U);  // the same size twice
}

void DatErrorsTest::options_that_do_not_fit() {
  ReadOptions options;
  // An error in a size that is not from the file has no line.
  QVERIFY(error_of([&] { dat("0 0\n", "99999x99999.dat"); }).startsWith("99999x99999.dat: the size 99999x99999 is "));
  options.size = {99'999, 99'999, 1};
  // The option is to blame, not the line of the file that it overrides.
  QVERIFY(error_of([&] { dat("# size 1\n0 0\n", "a.dat", options); }).startsWith("size: the size 99999x99999 is "));
  options.size = {2, 1, 1};
  options.spacing = 1e100;
  QCOMPARE(error_of([&] { dat("# spacing 5\n0 0\n1 0\n", "a.dat", options); }),
           QString("spacing: the spacing is too large; use a smaller spacing"));
  options.spacing = {};
  options.size = {3, 3, 1};
  QVERIFY(error_of([&] {
            dat("0 0\n1 0\n", "a.dat", options);
          }).startsWith("a.dat:2: the file ends without a row for element 2 (2 rows, but the size is 3x3); "));
  options.size = {2, 1, 1};
  options.space_dimension = 2;
  QCOMPARE(dat("0 1 1\n1 1 0\n", "a.dat", options)->space_dimension, 2);
  options.size = {2, 2, 1};
  options.space_dimension = 1;
  QVERIFY(error_of([&] {
            dat("0 0\n1 0\n2 0\n3 0\n", "a.dat", options);
          }).startsWith("space dimension 1: the object extends along 2 axes; "));
}

CHAINMAIL_TEST(DatErrorsTest)

}  // namespace chainmail::test_dat_errors

#include "test_dat_errors.moc"
