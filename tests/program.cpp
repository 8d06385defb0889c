#include "program.h"

#include <QElapsedTimer>
#include <QFile>
#include <QMetaMethod>
#include <array>
#include <cstdio>
#include <cstdlib>

namespace chainmail::test {
namespace {

/// The last class that was made known.
constinit const TestClass* last = nullptr;

const TestClass* find(const QByteArray& name) {
  const TestClass* found = last;
  while (found != nullptr && found->name() != name) {
    found = found->next;
  }
  return found;
}

int listClasses(const char* program) {
  std::fprintf(stderr, "usage: %s CLASS [options of Qt Test]\nThe classes:\n", program);
  for (const TestClass* known = last; known != nullptr; known = known->next) {
    std::fprintf(stderr, "  %s\n", known->name().constData());
  }
  return 2;
}

/// Returns the names of the test functions of a class.
QByteArrayList functionsOf(const QMetaObject& type) {
  QByteArrayList names;
  for (int i = type.methodOffset(); i < type.methodCount(); ++i) {
    const QMetaMethod method = type.method(i);
    const QByteArray name = method.name();
    const bool isSetUp = name == "initTestCase" || name == "cleanupTestCase" || name == "init" || name == "cleanup";
    if (method.methodType() == QMetaMethod::Slot && method.access() == QMetaMethod::Private &&
        method.parameterCount() == 0 && !isSetUp && !name.endsWith("_data")) {
      names << name;
    }
  }
  return names;
}

/// Returns the numbers of the bytes of a file that are not 0, and sets all to 0.
QByteArray takeNumbers(QFile& record) {
  record.seek(0);
  const QByteArray bytes = record.readAll();
  record.seek(0);
  record.write(QByteArray(bytes.size(), '\0'));
  record.flush();
  QByteArray numbers;
  for (qsizetype i = 0; i < bytes.size(); ++i) {
    numbers += bytes[i] == 0 ? QByteArray() : ' ' + QByteArray::number(i);
  }
  return numbers;
}

/// Runs the functions of a class one after the other, each in an application of its own, and prints for each that
/// passes its milliseconds and the planted faults that it reached (see tests/mutants).
int runEachFunction(const TestClass& chosen, char* program, const char* recordPath) {
  QFile record(QString::fromLocal8Bit(recordPath));
  if (!record.open(QIODevice::ReadWrite)) {
    return 2;
  }
  for (QByteArray name : functionsOf(chosen.type)) {
    QElapsedTimer timer;
    timer.start();
    std::array<char*, 3> arguments{program, name.data(), nullptr};
    const bool passes = chosen.run(2, arguments.data()) == 0;
    const QByteArray reached = takeNumbers(record);
    if (passes) {
      std::printf("\n@ %s %lld%s\n", name.constData(), static_cast<long long>(timer.elapsed()), reached.constData());
      std::fflush(stdout);
    }
  }
  return 0;
}

}  // namespace

TestClass::TestClass(const QMetaObject& its_type, Run its_run) : type(its_type), run(its_run), next(last) {
  last = this;
}

QByteArray TestClass::name() const {
  const QByteArray file = QByteArray(type.className()).split(':').value(2);  // of chainmail::test_cuts::CutsTest
  return file.startsWith("test_") ? file.mid(5) : file;
}

}  // namespace chainmail::test

/// Runs the class that the first argument names, with the other arguments.
int main(int argc, char** argv) {
  const chainmail::test::TestClass* chosen = argc > 1 ? chainmail::test::find(argv[1]) : nullptr;
  if (chosen == nullptr) {
    return chainmail::test::listClasses(argv[0]);
  }
  const char* record = std::getenv("CHAINMAIL_FAULTS_REACHED");
  if (record != nullptr && argc == 2) {
    return chainmail::test::runEachFunction(*chosen, argv[0], record);
  }
  argv[1] = argv[0];
  return chosen->run(argc - 1, argv + 1);
}
