// Tests the frame rate over time in a real window.

#include <QComboBox>
#include <QDeadlineTimer>
#include <QDir>
#include <QFile>
#include <QImage>
#include <QLabel>
#include <QTemporaryDir>
#include <functional>
#include <sstream>

#include "docks/frame_rate/frame_rate_dock.h"
#include "document/edits.h"
#include "document/panel_colour.h"
#include "report/page/format.h"
#include "window.h"
#include "window/message_bar.h"

namespace chainmail::window_rate {

namespace {

struct RateBench : Workbench {
  RateBench() : Workbench(generate({MeshKind::grid, {9, 7, 1}, 1, {}})) {}

  FrameRateDock& dock() { return *window.findChild<FrameRateDock*>(); }
  const report::Plot& plot() { return find<PlotWidget>("ratePlot")->plot(); }
  double end() { return plot().x.ends->back(); }
  void shake() {
    const QPoint from = place(0, 31);
    QList<QPoint> there{from};
    for (int i = 0; i < 12; ++i) {
      there << from + QPoint(i % 2 == 0 ? 120 : 0, -60);
    }
    stroke(0, there);
  }
  /// Drags until `met` returns true. The dock reads its figures five times per second while there are passes.
  bool shakeUntil(const std::function<bool()>& met) {
    for (const QDeadlineTimer limit(20'000); !met() && !limit.hasExpired();) {
      shake();
      QCoreApplication::processEvents();
    }
    return met();
  }
  bool shakeUntilSampled(std::size_t panel) {
    return shakeUntil([&] { return points(panel).size() > 3; });
  }
  bool shakeUntilShown() {
    return shakeUntil([&] { return find<QLabel>("painted0")->text().toInt() > 0; });
  }
  void set(const char* box, const QVariant& data) {
    auto* field = find<QComboBox>(box);
    field->setCurrentIndex(field->findData(data));
    emit field->activated(field->currentIndex());
  }
  /// Returns the points of a panel's lines.
  QPolygonF points(std::size_t panel) {
    QPolygonF all;
    for (const report::PlotCurve& curve : plot().panels.front().curves) {
      for (const auto& [x, y] : curve.points) {
        curve.series == panel ? all << QPointF(x, y) : all;
      }
    }
    return all;
  }
  void rest() { QTRY_COMPARE(find<QLabel>("painted0")->text(), QStringLiteral("idle")); }
};

QByteArray bytesOf(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

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

class WindowRate : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    failOnWarnings();
    QSettings().clear();
  }

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

  void aLineBreaksOffWhereNothingHappened() {
    const std::vector<RateSample> samples{sampleAt(1, 5), sampleAt(1.5, 6), sampleAt(4, 7), sampleAt(7.1, 2400)};
    const auto lines = curve(samples, 0, 10, 100);
    // The last pass started 0.7 s after the previous one ended.
    QCOMPARE(lines.size(), std::size_t{2});
    QCOMPARE(lines[0], (QPolygonF{{1, 5}, {1.5, 6}}));
    QCOMPARE(lines[1], (QPolygonF{{4, 7}, {7.1, 2400}}));
    QVERIFY(curve({}, 0, 10, 100).empty());
    // With many gaps, there are still no more points than requested.
    std::vector<RateSample> sparse;
    for (int i = 0; i < 3000; ++i) {
      sparse.push_back(sampleAt(0.2 * i + (i / 5) * 1.2, i));
    }
    QVERIFY(pointsIn(curve(sparse, 0, sparse.back().time, 500)) <= 500);
  }

  void theHistoryKeepsTenMinutes() {
    RateHistory history;
    for (int i = 0; i <= 4000; ++i) {
      history.add(sampleAt(i, 1));
    }
    QVERIFY(history.samples().size() <= 1300);  // at most twice as many: many old samples are removed at once
    QCOMPARE(history.since(3900).size(), std::size_t{102});
    QCOMPARE(history.since(3900).front().time, 3899.0);
  }

  void theTableHasEverySampleOnceInTheOrderOfTime() {
    std::vector<RateHistory> panels(2);
    panels[0].add(sampleAt(1, 0.5));
    panels[0].add(sampleAt(3, 0.25));
    panels[1].add(sampleAt(2, 8));
    panels[1].add(sampleAt(4, 16));
    std::ostringstream table;
    writeCsv(table, panels);
    const QList<QByteArray> rows = QByteArray::fromStdString(table.str()).trimmed().split('\n');
    QCOMPARE(rows.size(), 5);
    const auto isOf = [&](int row, const char* time, const char* panel, const char* ms) {
      const QList<QByteArray> fields = rows[row].split(',');
      return fields[0] == time && fields[1] == panel && fields[5] == ms;  // in milliseconds, as in the header
    };
    QVERIFY(isOf(1, "1", "A", "0.5") && isOf(2, "2", "B", "8"));
    QVERIFY(isOf(3, "3", "A", "0.25") && isOf(4, "4", "B", "16"));
  }

  void aPanelThatComesAgainBeginsAnew() {
    RateBench bench;
    bench.trigger("addPanel");
    bench.settle();
    QVERIFY(bench.shakeUntilSampled(2));
    bench.rest();
    const double before = bench.end();
    bench.trigger("removePanel");
    bench.settle();
    bench.trigger("addPanel");
    bench.settle();
    for (const QPointF& point : bench.points(2)) {
      QVERIFY(point.x() >= before);
    }
  }

  void theLagBehindTheEquilibriumIsPlotted() {
    RateBench bench;
    bench.set("rateQuantity", QStringLiteral("lag"));
    QVERIFY(bench.shakeUntilShown());
    bench.rest();
    QVERIFY(bench.points(0).empty());  // nothing relaxes
    edits::setRelaxation(bench.document(), {true, 1, RelaxationScheme::equilibrium});
    const auto lags = [&](double below) {
      const QPolygonF points = bench.points(0);
      return std::ranges::any_of(points,
                                 [&](const QPointF& point) { return point.y() < below; });  // 0: no energy is left
    };
    QVERIFY(bench.shakeUntilShown());
    QTRY_VERIFY_WITH_TIMEOUT(lags(1e-3), 12'000);
    QTemporaryDir folder;
    bench.dock().saveTablePath(folder.filePath(QStringLiteral("rates.csv")));
    const QList<QByteArray> rows = bytesOf(folder.filePath(QStringLiteral("rates.csv"))).trimmed().split('\n');
    QVERIFY(rows[0].endsWith(",lag"));
    QVERIFY(std::ranges::any_of(rows.mid(1), [](const QByteArray& row) { return !row.endsWith(','); }));
  }

  void bothPanelsAreOnOnePlot() {
    RateBench bench;
    QVERIFY(bench.shakeUntilSampled(0) && bench.shakeUntilSampled(1));
    bench.rest();
    for (const RateQuantity& one : rateQuantities().first(rateQuantities().size() - 1)) {  // nothing relaxes
      bench.set("rateQuantity", QString::fromUtf8(one.name.data(), qsizetype(one.name.size())));
      QVERIFY(bench.plot().title.starts_with(one.label));
      QCOMPARE(bench.plot().series.size(), bench.document().panels());
      for (std::size_t panel = 0; panel < 2; ++panel) {
        const QPolygonF points = bench.points(panel);
        QVERIFY2(points.size() > 3, one.name.data());
        QVERIFY(std::ranges::any_of(points, [](const QPointF& point) { return point.y() > 0; }) ||
                one.name.starts_with("violation"));
      }
    }
    QVERIFY(bench.plot().series[0].colour != bench.plot().series[1].colour);
    QCOMPARE(bench.plot().series[0].label, std::string("A Generalized ChainMail"));
    QVERIFY(bench.find<QLabel>("rateName1")->text().contains(QStringLiteral("Natural Queue")));
    bench.set("rateSpan", 60);
    QCOMPARE(bench.end() - bench.plot().x.ends->front(), 60.0);
    bench.choose(0, "Spiral");
    QVERIFY(bench.find<QLabel>("rateName0")->text().contains(QStringLiteral("Spiral")));
  }

  void aPlotStandsStillWhereItIsPausedOrNothingHappens() {
    RateBench bench;
    QVERIFY(bench.shakeUntilShown());
    bench.rest();
    const QList<QTimer*> readings = bench.dock().findChildren<QTimer*>(QString(), Qt::FindDirectChildrenOnly);
    QVERIFY(!readings.isEmpty());
    const auto isRead = [&] { return std::ranges::any_of(readings, &QTimer::isActive); };
    QTRY_VERIFY(!isRead());
    bench.settleFigures();
    QTRY_VERIFY(!isRead());  // nor does a last frame start the timer again
    const auto before = bench.points(0);
    const double to = bench.end();
    bench.settle();
    QVERIFY(!isRead());
    QCOMPARE(bench.end(), to);
    bench.trigger("pauseRates");
    QVERIFY(bench.shakeUntilShown());
    bench.rest();
    QCOMPARE(bench.points(0), before);
    QCOMPARE(bench.end(), to);
    bench.trigger("pauseRates");
    QVERIFY(bench.shakeUntilShown());
    bench.rest();
    QVERIFY(bench.end() > to);
    QVERIFY(bench.points(0) != before);
  }

  void theTableHoldsAllQuantitiesExactly() {
    const QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("rates.csv"));
    RateBench bench;
    bench.shake();
    const double ms = bench.document().solvers().frame(0)->statistics.last_pass_ms;
    bench.rest();
    QCOMPARE(bench.points(0).last().y(), ms);
    checkThatTheCursorReads(bench, ms);
    QVERIFY(std::uint64_t(bench.points(0).size()) <= bench.document().solvers().frame(0)->statistics.passes);
    bench.dock().saveTablePath(path);
    const QList<QByteArray> rows = bytesOf(path).trimmed().split('\n');
    QVERIFY(rows[0].startsWith("time_s,panel,algorithm,painted_per_s,passes_per_s,pass_ms,"));
    double time = 0;
    bool found = false;
    for (const QByteArray& row : rows.mid(1)) {
      const QList<QByteArray> fields = row.split(',');
      QCOMPARE(fields.size(), rows[0].split(',').size());
      QVERIFY(fields[0].toDouble() >= time);
      time = fields[0].toDouble();
      found = found || (fields[1] == "A" && fields[2] == "generalized" && fields[5].toDouble() == ms);
      // The painted rate is always present; times of the solver only if there was a pass.
      QVERIFY(!fields[3].isEmpty());
      QCOMPARE(fields[4].isEmpty(), fields[5].isEmpty());
    }
    QVERIFY(found);
  }

  void thePlotIsSavedAsPictureAndForPrint() {
    const QTemporaryDir folder;
    RateBench bench;
    bench.set("rateQuantity", QStringLiteral("painted"));
    QVERIFY(bench.shakeUntilShown());
    bench.rest();
    bench.dock().savePicturePath(folder.filePath(QStringLiteral("rates.png")));
    const QImage picture(folder.filePath(QStringLiteral("rates.png")));
    QVERIFY(picture.width() > 1500);
    for (int panel = 0; panel < 2; ++panel) {
      int pixels = 0;
      for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
          pixels += picture.pixelColor(x, y) == panelColour(bench.document(), panel).on(colours::Ground::light) ? 1 : 0;
        }
      }
      QVERIFY(pixels > 100);  // the line in the legend alone would be longer
    }
    bench.dock().savePicturePath(folder.filePath(QStringLiteral("rates.pdf")));
    QVERIFY(bytesOf(folder.filePath(QStringLiteral("rates.pdf"))).startsWith("%PDF-"));
    bench.dock().savePicturePath(folder.filePath(QStringLiteral("missing/rates.png")));
    QVERIFY(bench.window.messages().sentence().contains(QStringLiteral("missing")));
    bench.dock().saveTablePath(folder.filePath(QStringLiteral("missing/rates.csv")));
    QVERIFY(bench.window.messages().isVisible());
  }

 private:
  static void checkThatTheCursorReads(RateBench& bench, double ms) {
    auto& plot = *bench.find<PlotWidget>("ratePlot");
    QStringList readings;
    for (int x = 0; x < plot.width(); ++x) {
      readings << plot.readingAt(QPointF(x, plot.height() / 2)).split(QLatin1Char('\n'));
    }
    QVERIFY2(readings.contains(QString::fromStdString(plot.plot().series[0].label + ": " + report::figure(ms) + " ms")),
             qPrintable(readings.join(QLatin1Char('|'))));
    QVERIFY(plot.readingAt(QPointF(0, 0)).isEmpty());  // outside the axes
  }
};

CHAINMAIL_WINDOW_TEST(WindowRate)

}  // namespace chainmail::window_rate

#include "window_rate.moc"
