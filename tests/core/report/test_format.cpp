#include <QtTest>

#include "program.h"
#include "report/table/format.h"

namespace chainmail::test_format {

/// Numbers as texts for people.
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
};

CHAINMAIL_TEST(FormatTest)

}  // namespace chainmail::test_format

#include "test_format.moc"
