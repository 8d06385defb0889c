#pragma once

#include <sys/resource.h>

#include <QFile>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QTemporaryDir>
#include <QtTest>
#include <functional>

#include "folders.h"

namespace chainmail::test {

/// The result of a run of the program.
struct Outcome {
  int code = -1;
  QByteArray out;
  QByteArray error;
};

/// Runs the program in its own temporary folder.
class Program {
 public:
  /// Runs the program. `prepare` is called in the new process before the program starts.
  Outcome run(const QStringList& arguments, const std::function<void()>& prepare = {}) const {
    QProcess process;
    process.setChildProcessModifier(prepare);
    process.setWorkingDirectory(folder_.path());
    process.setStandardInputFile(QProcess::nullDevice());
    process.start(builtFile("bin/chainmail"), arguments);
    process.waitForFinished(60'000);
    const bool ended = process.exitStatus() == QProcess::NormalExit && process.state() == QProcess::NotRunning;
    return {ended ? process.exitCode() : -1, process.readAllStandardOutput(), process.readAllStandardError()};
  }
  /// Runs the program with the arguments in `line`, separated by spaces.
  Outcome run(const char* line) const { return run(QString(line).split(' ', Qt::SkipEmptyParts)); }

  QString path(const QString& name) const { return folder_.filePath(name); }
  QByteArray read(const QString& name) const {
    QFile file(path(name));
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray("no such file");
  }
  void write(const QString& name, const QByteArray& text) const {
    QFile file(path(name));
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write(text) == text.size());
  }
  QJsonObject json(const QString& name) const { return QJsonDocument::fromJson(read(name)).object(); }
  QStringList files() const {
    return QDir(folder_.path()).entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot);
  }

 private:
  QTemporaryDir folder_;
};

/// Limits processor time and address space of a process, for Program::run. A sanitizer takes more of both.
inline void limit_resources(rlim_t seconds, rlim_t bytes = RLIM_INFINITY) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  seconds *= 10;
  bytes = RLIM_INFINITY;
#endif
  const rlimit time{seconds, seconds}, space{bytes, bytes};
  setrlimit(RLIMIT_CPU, &time);
  setrlimit(RLIMIT_AS, &space);
}

/// Checks that standard error is one line that begins with `chainmail: WHERE` and says what to do.
inline bool is_one_sentence(const Outcome& outcome) {
  return outcome.out.isEmpty() && outcome.error.startsWith("chainmail: ") && outcome.error.endsWith('\n') &&
         outcome.error.count('\n') == 1 && outcome.error.contains("; ");
}

/// Runs a wrong command line, and checks that it gives one sentence with the position of the error and changes no file.
inline void check_refused(const Program& program, const char* line, const QString& where) {
  const auto before = program.files();
  const auto outcome = program.run(line);
  QCOMPARE(outcome.code, 2);
  QVERIFY2(is_one_sentence(outcome), outcome.error);
  QVERIFY2(QString::fromUtf8(outcome.error).startsWith("chainmail: " + where), outcome.error);
  QCOMPARE(program.files(), before);
}

/// Returns the rows of a CSV table without its header.
inline QList<QList<QByteArray>> rows_of(const QByteArray& csv) {
  QList<QList<QByteArray>> rows;
  for (const QByteArray& line : csv.trimmed().split('\n')) {
    rows.append(line.split(','));
  }
  rows.removeFirst();
  return rows;
}

}  // namespace chainmail::test
