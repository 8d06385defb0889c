// Tests the lines of figures over time.

#include "docks/rate_history.h"

#include <QTest>
#include <algorithm>

#include "program.h"

namespace chainmail::rate_history {

namespace {

RateSample sampleAt(double time, double ms) {
  RateSample sample;
  sample.time = time;
  sample.ms = ms;
  return sample;
}

const RateQuantity& quantity(std::string_view name) {
  return *std::ranges::find(rateQuantities(), name, &RateQuantity::name);
}

std::vector<QPolygonF> curve(const std::vector<RateSample>& samples, double from, double to, std::size_t points) {
  return curveOf(samples, quantity("ms"), from, to, points);
}

std::size_t pointsIn(const std::vector<QPolygonF>& lines) {
  std::size_t points = 0;
  for (const QPolygonF& line : lines) {
    points += std::size_t(line.size());
  }
  return points;
}

}  // namespace

class RateHistoryTest : public QObject {
  Q_OBJECT

 private slots:
  void spikesStayHoweverManySamplesThereAre() {
    std::vector<RateSample> samples;
    for (int i = 0; i < 36'000; ++i) {
      samples.push_back(sampleAt(i / 60.0, i == 17'777 ? 40 : i == 20'001 ? 0.001 : 1 + 0.1 * (i % 7)));
    }
    const auto lines = curve(samples, 0, 600, 500);
    QCOMPARE(lines.size(), std::size_t{1});
    QVERIFY(pointsIn(lines) <= 500);
    QVERIFY(lines[0].contains(QPointF(17'777 / 60.0, 40)) && lines[0].contains(QPointF(20'001 / 60.0, 0.001)));
    QVERIFY(std::ranges::is_sorted(lines[0], {}, &QPointF::x));
    // A small number of samples is drawn completely.
    samples.resize(300);
    QCOMPARE(pointsIn(curve(samples, 0, 10, 500)), std::size_t{300});
  }
};

CHAINMAIL_TEST(RateHistoryTest)

}  // namespace chainmail::rate_history

#include "rate_history.moc"
