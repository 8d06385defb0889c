// Tests that no settings file ends or delays every start.

#include <sys/stat.h>
#include <unistd.h>

#include <QDir>
#include <QFile>
#include <QProcess>
#include <QSettings>
#include <QTest>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "program.h"
#include "window/startup.h"

namespace chainmail::start_guard {

class StartGuardTest : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() {
    QCoreApplication::setOrganizationName(QStringLiteral("ChainMail"));
    QCoreApplication::setApplicationName(QStringLiteral("workbench"));
    QSettings::setDefaultFormat(QSettings::IniFormat);
  }

  void init() {
    folder_ = std::make_unique<QTemporaryDir>();
    qputenv("XDG_CONFIG_HOME", folder_->path().toUtf8());
    QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, folder_->path());
    QVERIFY(QDir(folder_->path()).mkdir(QStringLiteral("ChainMail")));
    path_ = folder_->filePath(QStringLiteral("ChainMail/workbench.ini"));
  }

  void goodSettingsStay() {
    QSettings().setValue(QStringLiteral("theme"), QStringLiteral("light"));
    for (int start = 0; start < 4; ++start) {
      const StartGuard guard;
      QCOMPARE(guard.notes(), QStringList());
    }
    QCOMPARE(QSettings().value(QStringLiteral("theme")).toString(), QStringLiteral("light"));
  }

  /// Nobody writes to the pipe, so reading would never end.
  void aPipeIsNotRead() {
    QVERIFY(::mkfifo(qPrintable(path_), 0600) == 0);
    const StartGuard guard;
    QCOMPARE(guard.notes().size(), 1);
    QVERIFY2(guard.notes().first().startsWith(path_), qPrintable(guard.notes().first()));
    QSettings().setValue(QStringLiteral("theme"), QStringLiteral("light"));
    QCOMPARE(QSettings().value(QStringLiteral("theme")).toString(), QStringLiteral("light"));
  }

  void valuesThatQtTrustsAreSetAside_data() {
    QTest::addColumn<QByteArray>("text");
    QTest::newRow("binary") << QByteArray("[General]\ntheme=@Variant(\\0\\0\\0\\x7f\\0\\0\\0\\x1)\n");
    QTest::newRow("huge") << QByteArray("[General]\ntheme=") + QByteArray(5 << 20, 'x');
  }
  void valuesThatQtTrustsAreSetAside() {
    QFETCH(const QByteArray, text);
    write(text);
    const StartGuard guard;
    QCOMPARE(guard.notes().size(), 1);
    QVERIFY(guard.notes().first().contains(path_ + QStringLiteral(".old")));
    QVERIFY(!QSettings().contains(QStringLiteral("theme")));
  }

  void settingsOfAnEarlierVersionGetOneNote() {
    write(
        "[General]\ngeometry=@ByteArray(\\x1\\xd9)\nlayout=@ByteArray(\\0\\0\\0\\xff)\ntheme=light\n\n[folds]"
        "\nmeshDock=true\n");
    {
      const StartGuard guard;
      QCOMPARE(guard.notes().size(), 1);
      QVERIFY(guard.notes().first().contains(QStringLiteral("the layout of the docks")));
    }
    QCOMPARE(QSettings().allKeys(), QStringList{QStringLiteral("theme")});
    QCOMPARE(StartGuard().notes(), QStringList());
  }

  void twoStartsWithoutAFrameMakeTheThirdBeginWithDefaults() {
    QSettings().setValue(QStringLiteral("theme"), QStringLiteral("light"));
    for (int failed = 0; failed < 2; ++failed) {
      QVERIFY(!crashedStart().contains("default settings"));
    }
    {
      StartGuard guard;
      QVERIFY2(guard.notes().value(0).contains(QStringLiteral("default settings")), qPrintable(guard.notes().value(0)));
      QVERIFY(!QSettings().contains(QStringLiteral("theme")));
      const QSettings former(path_ + QStringLiteral(".old"), QSettings::IniFormat);
      QCOMPARE(former.value(QStringLiteral("theme")).toString(), QStringLiteral("light"));
    }
    QCOMPARE(StartGuard().notes(), QStringList());
  }

  void aStartThatWorksForgetsOneThatDidNot() {
    for (int round = 0; round < 3; ++round) {
      (void)crashedStart();
      StartGuard guard;
      guard.succeed();
      QCOMPARE(guard.notes(), QStringList());
    }
  }

  /// Several files may be opened at once, each by a program of its own.
  void startsAtTheSameTimeAreNoFailures() {
    std::array<QProcess, 3> others;
    for (QProcess& other : others) {
      start(other, "--wait");
      QVERIFY(other.waitForReadyRead());
    }
    QCOMPARE(StartGuard().notes(), QStringList());
    for (QProcess& other : others) {
      other.kill();
      other.waitForFinished();
    }
  }

 private:
  static void start(QProcess& process, const char* how) {
    process.start(QCoreApplication::applicationFilePath(), {QStringLiteral("start_guard"), QLatin1String(how)});
  }

  /// Starts a program that ends before its first frame, and returns what it said.
  static QByteArray crashedStart() {
    QProcess process;
    start(process, "--crash");
    process.waitForFinished();
    return process.readAllStandardOutput();
  }

  void write(const QByteArray& text) {
    QFile file(path_);
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write(text) == text.size());
  }

  std::unique_ptr<QTemporaryDir> folder_;
  QString path_;
};

namespace {

/// A start of the program, up to its first frame.
int startOnly(bool waits) {
  QCoreApplication::setOrganizationName(QStringLiteral("ChainMail"));
  QCoreApplication::setApplicationName(QStringLiteral("workbench"));
  QSettings::setDefaultFormat(QSettings::IniFormat);
  const StartGuard guard;
  std::printf("started\n%s\n", qPrintable(guard.notes().join(QLatin1Char('\n'))));
  std::fflush(stdout);
  if (waits) {
    ::pause();
  }
  std::_Exit(1);
}

int runClass(int argc, char** argv) {
  const std::string_view how = argc > 1 ? argv[1] : "";
  return how == "--crash" || how == "--wait" ? startOnly(how == "--wait") : test::runTest<StartGuardTest>(argc, argv);
}

}  // namespace

CHAINMAIL_TEST_RUN(StartGuardTest, runClass)

}  // namespace chainmail::start_guard

#include "start_guard.moc"
