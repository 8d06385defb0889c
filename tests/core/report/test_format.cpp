#include <QDateTime>
#include <QtTest>
#include <ctime>

#include "program.h"
#include "report/table/format.h"
#include "report/table/machine.h"

namespace chainmail::test_format {

/// Numbers and times as texts for people.
class FormatTest : public QObject {
  Q_OBJECT

 private slots:
  void a_time_has_a_unit_that_fits() {
    const std::pair<double, const char*> times[]{{0.00021, "0.21 µs"}, {0.0999, "99.9 µs"}, {0.1, "0.1 ms"},
                                                 {12.345, "12.3 ms"},  {1000, "1,000 ms"},  {1234, "1.23 s"},
                                                 {65'000, "65 s"}};
    for (const auto& [ms, words] : times) {
      QCOMPARE(report::time_in_words(ms), std::string(words));
    }
  }

  void the_time_of_a_report_is_utc_in_every_zone() {
    const QByteArray before = qgetenv("TZ");
    qputenv("TZ", "ABC-5:30");
    ::tzset();
    const auto utc = [] { return QDateTime::currentDateTimeUtc().toString("yyyy-MM-dd hh:mm 'UTC'").toStdString(); };
    const std::string earliest = utc(), now = report::now_in_words(), latest = utc();
    before.isNull() ? qunsetenv("TZ") : qputenv("TZ", before);
    ::tzset();
    QVERIFY2(now == earliest || now == latest, now.c_str());
  }
};

CHAINMAIL_TEST(FormatTest)

}  // namespace chainmail::test_format

#include "test_format.moc"
