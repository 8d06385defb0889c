#include "cli/chainmail_program.h"
#include "program.h"

namespace chainmail::test_usage {

using namespace chainmail::test;

/// Tests help, version, and the errors for wrong arguments.
class UsageTest : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    program_ = std::make_unique<Program>();
    QCOMPARE(program_->run("generate grid 4x3 -o grid.dat").code, 0);
  }
  void help_shows_an_example_data();
  void help_shows_an_example();
  void version();
  void wrong_arguments_data();
  void wrong_arguments();
  void odd_names_stay_one_line();

 private:
  std::unique_ptr<Program> program_;
};

void UsageTest::help_shows_an_example_data() {
  QTest::addColumn<QString>("line");
  QTest::addColumn<QString>("example");
  QTest::newRow("root") << "--help"
                        << "chainmail generate grid";
  QTest::newRow("deform") << "deform --help"
                          << "chainmail deform ";
}

void UsageTest::help_shows_an_example() {
  QFETCH(QString, line);
  QFETCH(QString, example);
  const auto outcome = program_->run(line.toUtf8().constData());
  QCOMPARE(outcome.code, 0);
  QVERIFY(outcome.error.isEmpty());
  const QString text = QString::fromUtf8(outcome.out);
  QVERIFY(text.contains("Example:\n  " + example));
}

void UsageTest::version() {
  const auto outcome = program_->run("--version");
  QCOMPARE(outcome.code, 0);
  QVERIFY(QRegularExpression("^chainmail \\d+\\.\\d+\\.\\d+ \\([^()]+, [A-Za-z]+\\)\nMIT licence[.] ")
              .match(outcome.out)
              .hasMatch());
}

void UsageTest::wrong_arguments_data() {
  QTest::addColumn<QString>("where");
  const auto row = [](const char* line, const char* where) { QTest::newRow(line) << where; };
  row("", "command: ");
  row("foo", "foo: there is no such command; ");
  row("--foo", "--foo: there is no such option; ");
  row("generate", "KIND: it is missing; ");
  row("generate grid 3x3 -o", "-o: its value is missing; ");
  row("generate grid 3x3 4 -o a.dat", "4: unexpected argument; ");
  row("generate grid 3x3 --foo -o a.dat", "--foo: there is no such option; ");
  row("info --", "MESH: it is missing; ");
  row("info -- --none.obj", "--none.obj: there is no such file; ");
  row("deform grid.dat", "--algorithm: it is missing; ");
  row("deform grid.dat --algorithm best",
      "--algorithm: 'best' is not known; use generalized, spiral, natural-queue, enhanced, 3d, exact, fem, ");
  row("deform grid.dat --algorithm spiral --algorithm spiral", "--algorithm: it was given 2 times; ");
  row("deform grid.dat --algorithm spiral --json --trace a.csv", "--json: its value is missing; ");
  row("deform grid.dat --algorithm spiral --steps 1000000000 --by 0:1",
      "--steps: the moves have more than 100000 passes in all");
  for (const char* option : {"--compression nan", "--stretch inf", "--shear 1e999", "--shear 0.1x", "--stretch 1,5"}) {
    const QByteArray text = option;
    row("deform grid.dat --algorithm spiral " + text, text.left(text.indexOf(' ')) + ": '");
  }
  for (const char* option : {"--steps 1.5", "--steps 1e3", "--size 4", "--size 4x3x1x1"}) {
    const QByteArray text = option;
    row("deform grid.dat --algorithm spiral " + text, text.left(text.indexOf(' ')) + ": '");
  }
}

void UsageTest::wrong_arguments() {
  QFETCH(QString, where);
  const auto outcome = program_->run(QTest::currentDataTag());
  QCOMPARE(outcome.code, 2);
  QVERIFY2(is_one_sentence(outcome), outcome.error);
  QVERIFY2(QString::fromUtf8(outcome.error).startsWith("chainmail: " + where), outcome.error);
  QCOMPARE(program_->files(), QStringList{"grid.dat"});
}

void UsageTest::odd_names_stay_one_line() {
  for (const char* name : {"a\nb.dat", "\x1b[31m.obj", "", " ", "-"}) {
    const auto outcome = program_->run(QStringList{"info", name});
    QCOMPARE(outcome.code, 2);
    QVERIFY2(is_one_sentence(outcome) && !outcome.error.contains('\x1b'), outcome.error);
  }
}

CHAINMAIL_TEST(UsageTest)

}  // namespace chainmail::test_usage

#include "test_usage.moc"
