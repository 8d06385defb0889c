#include <QtTest>
#include <sstream>

#include "command_line/progress_line.h"
#include "program.h"

namespace chainmail::test_progress_line {

using command_line::ProgressLine;
using std::chrono::seconds;

/// Tests what long commands say while they work, with a clock that the test drives.
class ProgressLineTest : public QObject {
  Q_OBJECT

 private slots:
  void short_work_says_nothing();
  void without_a_terminal_a_line_per_minute();
  void on_a_terminal_one_line_is_rewritten();
  void what_is_left_is_estimated_data();
  void what_is_left_is_estimated();
  void work_without_shares_says_its_text();
};

constexpr ProgressLine::Time start{std::chrono::hours(5)};
constexpr auto clear = "\r\x1b[K";

Progress job_of(const std::string& text, double share = 0) {
  const Progress job = Progress::watched();
  job.say(text);
  job.show(share);
  return job;
}

/// Returns what a line shows of work if it is due `elapsed` after the start.
std::string shown(const Progress& job, bool is_terminal, std::chrono::milliseconds elapsed) {
  std::ostringstream out;
  ProgressLine line(out, is_terminal, start);
  line.show(job, start + elapsed);
  return out.str();
}

void ProgressLineTest::short_work_says_nothing() {
  for (const bool is_terminal : {false, true}) {
    std::ostringstream out;
    {
      const ProgressLine line(out, is_terminal, start);
      QVERIFY(line.next() == start + (is_terminal ? std::chrono::milliseconds(300) : seconds(10)));
    }
    QCOMPARE(out.str(), std::string());
  }
}

/// The work ends after 200 s: four lines. They have no control characters, and none is cleared at the end.
void ProgressLineTest::without_a_terminal_a_line_per_minute() {
  const Progress job = job_of("bar, bend");
  std::ostringstream out;
  {
    ProgressLine line(out, false, start);
    for (auto now = line.next(); now < start + seconds(200); now = line.next()) {
      job.show((now - start) / std::chrono::duration<double>(450));
      line.show(job, now);
    }
  }
  QCOMPARE(out.str(), std::string("2 % after 10 s, about 7 min left: bar, bend\n"
                                  "15 % after 1 min, about 6 min left: bar, bend\n"
                                  "28 % after 2 min, about 5 min left: bar, bend\n"
                                  "42 % after 3 min, about 4 min left: bar, bend\n"));
}

void ProgressLineTest::on_a_terminal_one_line_is_rewritten() {
  const Progress job = job_of("bar, bend", 0.25);
  std::ostringstream out;
  {
    ProgressLine line(out, true, start);
    line.show(job, start + seconds(4));
    QVERIFY(line.next() == start + std::chrono::milliseconds(4200));
    job.show(0.5);
    line.show(job, start + seconds(60));
  }
  QCOMPARE(out.str(), clear + std::string("25 %, bar, bend") + clear + "50 %, bar, bend, about 1 min left" + clear);
}

void ProgressLineTest::what_is_left_is_estimated_data() {
  QTest::addColumn<double>("share");
  QTest::addColumn<int>("elapsed");  // s
  QTest::addColumn<QString>("left");
  QTest::newRow("from a small share") << 0.02 << 600 << "";
  QTest::newRow("from a larger one") << 0.021 << 600 << ", about 7 h 50 min left";
  QTest::newRow("after a short time") << 0.5 << 4 << "";
  QTest::newRow("after a longer one") << 0.5 << 5 << ", about 5 s left";
  QTest::newRow("almost done") << 0.99 << 60 << ", about 5 s left";
  QTest::newRow("done") << 1.0 << 60 << "";
  QTest::newRow("seconds") << 0.5 << 42 << ", about 40 s left";
  QTest::newRow("seconds that are a minute") << 0.5 << 58 << ", about 1 min left";
  QTest::newRow("minutes") << 0.25 << 61 << ", about 3 min left";
  QTest::newRow("minutes that are an hour") << 0.5 << 3580 << ", about 1 h left";
  QTest::newRow("an hour and minutes") << 0.5 << 4150 << ", about 1 h 10 min left";
  QTest::newRow("hours") << 0.5 << 7150 << ", about 2 h left";
}

void ProgressLineTest::what_is_left_is_estimated() {
  QFETCH(double, share);
  QFETCH(int, elapsed);
  QFETCH(QString, left);
  QCOMPARE(QString::fromStdString(shown(job_of("bar", share), true, seconds(elapsed))),
           clear + QString("%1 %, bar").arg(int(100 * share)) + left);
}

void ProgressLineTest::work_without_shares_says_its_text() {
  const Progress job = job_of("40x40");
  QCOMPARE(shown(job, false, seconds(180)), std::string("after 3 min: 40x40\n"));
  QCOMPARE(shown(job, true, seconds(180)), clear + std::string("40x40"));
}

CHAINMAIL_TEST(ProgressLineTest)

}  // namespace chainmail::test_progress_line

#include "test_progress_line.moc"
