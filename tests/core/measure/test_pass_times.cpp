#include <QtTest>

#include "measure/pass_times.h"
#include "program.h"

namespace chainmail::test_pass_times {

using namespace std::chrono_literals;

/// The times of the passes of the last second, with a clock that the test controls.
class PassTimesTest : public QObject {
  Q_OBJECT

 private slots:
  void nothing_happened();
  void median_and_worst();
  void what_is_older_than_a_second_is_forgotten();
  void memory_is_bounded();

 private:
  const PassTimes::Clock::time_point start_{1h};
};

void PassTimesTest::nothing_happened() {
  PassTimes times;
  QCOMPARE(times.summary(start_).passes, 0);
  QCOMPARE(times.summary(start_).worst_ms, 0.0);
}

void PassTimesTest::median_and_worst() {
  PassTimes times;
  for (const double milliseconds : {3.0, 9.0, 1.0, 2.0, 4.0}) {
    times.add(start_, milliseconds);
  }
  const auto summary = times.summary(start_ + 500ms);
  QCOMPARE(summary.passes, 5);
  QCOMPARE(summary.median_ms, 3.0);
  QCOMPARE(summary.worst_ms, 9.0);
}

void PassTimesTest::what_is_older_than_a_second_is_forgotten() {
  PassTimes times;
  times.add(start_, 9);
  times.add(start_ + 700ms, 2);
  QCOMPARE(times.summary(start_ + 900ms).worst_ms, 9.0);
  QCOMPARE(times.summary(start_ + 1500ms).worst_ms, 2.0);
  QCOMPARE(times.summary(start_ + 1500ms).passes, 1);
  QCOMPARE(times.summary(start_ + 5s).passes, 0);
}

void PassTimesTest::memory_is_bounded() {
  PassTimes times;
  for (int i = 0; i < 100'000; ++i) {
    times.add(start_ + std::chrono::microseconds(i), 1);
  }
  QVERIFY(times.summary(start_ + 100ms).passes < 10'000);
  times.clear();
  QCOMPARE(times.summary(start_ + 100ms).passes, 0);
}

CHAINMAIL_TEST(PassTimesTest)

}  // namespace chainmail::test_pass_times

#include "test_pass_times.moc"
