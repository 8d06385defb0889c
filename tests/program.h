#pragma once

#include <QCoreApplication>
#include <QTest>

// Qt 6.4 looks at the condition of QTRY_… every 50 ms, which tests would mostly sleep. This looks every millisecond.
#ifdef QTRY_LOOP_IMPL
#undef QTRY_LOOP_IMPL
#define QTRY_LOOP_IMPL(expr, timeoutValue, step)                                                         \
  int qt_test_i = 0;                                                                                     \
  for (; qt_test_i < (timeoutValue) && !(QTest::runningTest() && QTest::currentTestFailed()) && !(expr); \
       ++qt_test_i) {                                                                                    \
    QTest::qWait(qt_test_i == 0 ? 0 : 1);                                                                \
  }
#endif

namespace chainmail::test {

/// A test class of this program. Its name is that of its namespace, which is that of its file, without "test_".
struct TestClass {
  using Run = int (*)(int argc, char** argv);

  TestClass(const QMetaObject& type, Run run);

  QByteArray name() const;

  const QMetaObject& type;
  Run run;
  const TestClass* next;
};

/// Runs a test class that needs no window.
template <class Test>
int runTest(int argc, char** argv) {
  const QCoreApplication application(argc, argv);
  Test test;
  return QTest::qExec(&test, argc, argv);
}

}  // namespace chainmail::test

/// Makes a test class known to its program, which runs it with a function.
#define CHAINMAIL_TEST_RUN(Test, run) static const chainmail::test::TestClass known##Test(Test::staticMetaObject, run);
/// The same, for a class that needs no window.
#define CHAINMAIL_TEST(Test) CHAINMAIL_TEST_RUN(Test, chainmail::test::runTest<Test>)
